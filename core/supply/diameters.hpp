// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/mixture.hpp"
#include "core/world/model.hpp"

#include <algorithm>

namespace talus
{

/// The diameters of all spheres that there are, or will be.
struct Diameters {
    double min = infinity, max = 0.0; ///< [m]
    double sum = 0.0, count = 0.0;

    /// Spheres of one diameter.
    void add(double diameter, double number = 1.0) { add(diameter, diameter, diameter, number); }
    void add(const Mixture& mixture, double number)
    {
        add(mixture.min_diameter(), mixture.max_diameter(), mixture.mean_diameter(), number);
    }
    void put_into(Model& model) const
    {
        model.min_diameter = min;
        model.max_diameter = max;
        model.mean_diameter = sum / count;
    }

private:
    void add(double least, double most, double mean, double number)
    {
        if (number == 0.0) return;
        min = std::min(min, least);
        max = std::max(max, most);
        sum += mean * number;
        count += number;
    }
};

} // namespace talus
