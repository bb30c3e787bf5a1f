// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// The columns of a file of spheres, whatever its kind.
struct SphereColumns {
    std::vector<std::string> names; ///< as the file has them; the components of a vector apart: "velocity_x"
    std::size_t rows = 0;
    std::function<double(std::size_t row, std::size_t column)> number; ///< @throws InputError where it is none
    std::function<std::string(std::size_t row, std::size_t column)> text;
    std::function<void(std::size_t row, const std::string& sentence)> refuse_row; ///< throws InputError
    std::function<void(const std::string& sentence)> refuse;                      ///< throws InputError
};

/// What the columns say of spheres, in the order of their ids where they have any. Other codes' names are known, too,
/// whatever their capitals, and with units behind them: io/README.md lists them.
/// @param materials of the scene, by the numbers that the file may have for them
scene::SphereList spheres_of(const SphereColumns& columns, const std::vector<std::string>& materials);

/// Whether a column or array of this name is a vector, or a number, that spheres have; else neither.
bool is_vector_of_spheres(std::string_view name);
bool is_number_of_spheres(std::string_view name);

} // namespace talus
