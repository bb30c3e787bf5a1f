// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/mixture.hpp"

#include <algorithm>

namespace talus
{
namespace
{

double mean_mass_of(const Species& species, const Materials& materials)
{
    return materials.list[static_cast<std::size_t>(species.material)].density * species.diameter.mean_volume();
}

} // namespace

Grain Mixture::draw(Random& random) const
{
    auto drawn = species.begin();
    if (species.size() > 1) {
        double u = uniform(random);
        for (; drawn + 1 != species.end() && u >= drawn->number; ++drawn) u -= drawn->number;
    }
    return {drawn->diameter.draw(random), drawn->material};
}

double Mixture::min_diameter() const
{
    double smallest = infinity;
    for (const Species& s : species) smallest = std::min(smallest, s.diameter.min);
    return smallest;
}

double Mixture::max_diameter() const
{
    double largest = 0.0;
    for (const Species& s : species) largest = std::max(largest, s.diameter.max);
    return largest;
}

double Mixture::mean_diameter() const
{
    double sum = 0.0;
    for (const Species& s : species) sum += s.number * s.diameter.mean();
    return sum;
}

double Mixture::mean_volume() const
{
    double sum = 0.0;
    for (const Species& s : species) sum += s.number * s.diameter.mean_volume();
    return sum;
}

double Mixture::mean_mass(const Materials& materials) const
{
    double sum = 0.0;
    for (const Species& s : species) sum += s.number * mean_mass_of(s, materials);
    return sum;
}

Mixture mixture_by_mass(
    std::vector<Species> species, const std::vector<double>& mass_shares, const Materials& materials)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < species.size(); ++k) {
        species[k].number = mass_shares[k] / mean_mass_of(species[k], materials);
        sum += species[k].number;
    }
    for (Species& s : species) s.number /= sum;
    return {std::move(species)};
}

} // namespace talus
