// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sphere_columns.hpp"

#include "io/text/input_file.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace talus
{
namespace
{

/// What a column may be called, in small letters and without its unit; what comes first is taken before the others.
/// Vectors have _x, _y, _z behind their names, or x, y, z.
using Names = std::vector<std::string_view>;
const Names position_names = {"", "position", "points", "pos", "coordinates", "unwrapped"};
const Names velocity_names = {"v", "velocity", "vel", "velocities"};
const Names spin_names = {"w", "angular_velocity", "angularvelocity", "omega", "angvel", "spin"};
const Names radius_names = {"radius", "r", "rad", "radii"}, diameter_names = {"diameter", "dia"},
            id_names = {"id", "ids", "particle_id", "particleid"}, material_names = {"material", "type"};

/// Small letters, without a unit ("radius_m", "radius [m]"), with one mark between words and x, y, z for components.
std::string plain(std::string_view name)
{
    std::string text;
    for (const unsigned char c : name.substr(0, name.find_first_of("[(")))
        text += c == ':' || c == ' ' || c == '.' ? '_' : static_cast<char>(std::tolower(c));
    while (text.ends_with('_')) text.pop_back();
    for (const std::string_view unit : {"_rad_per_s", "_m_per_s", "_rad/s", "_m/s", "_m"})
        if (text.ends_with(unit) && text.size() > unit.size()) {
            text.erase(text.size() - unit.size());
            break;
        }
    if (text == "xu" || text == "yu" || text == "zu") return fmt::format("unwrapped_{}", text[0]);
    if (text.size() > 2 && text[text.size() - 2] == '_' && text.back() >= '0' && text.back() <= '2')
        text.back() = static_cast<char>(text.back() - '0' + 'x');
    return text;
}

/// Finds columns by what they may be called, and notes which were.
class Finder
{
public:
    explicit Finder(const SphereColumns& columns) : columns_(columns), taken_(columns.names.size())
    {
        for (std::size_t k = 0; k < columns.names.size(); ++k) at_.try_emplace(plain(columns.names[k]), k);
    }

    std::optional<std::size_t> number(const Names& names)
    {
        for (const std::string_view name : names)
            if (const auto found = at_.find(std::string(name)); found != at_.end()) return take(found->second);
        return std::nullopt;
    }

    /// All three, or nothing.
    std::optional<std::array<std::size_t, 3>> vector(const Names& names)
    {
        for (const std::string_view name : names)
            for (const std::string_view mark : {"_", ""}) {
                std::array<std::map<std::string, std::size_t>::const_iterator, 3> found;
                for (std::size_t d = 0; d < 3; ++d)
                    found[d] = at_.find(fmt::format("{}{}{}", name, name.empty() ? "" : mark, "xyz"[d]));
                const auto missing = std::ranges::count(found, at_.end());
                if (missing == 3) continue;
                if (missing > 0)
                    columns_.refuse(fmt::format(
                        "of '{0}{1}x', '{0}{1}y' and '{0}{1}z' all must be there", name, name.empty() ? "" : mark));
                return std::array{take(found[0]->second), take(found[1]->second), take(found[2]->second)};
            }
        return std::nullopt;
    }

    /// "takes x, y, z, radius; passes over mass"
    std::string said() const
    {
        std::array<std::vector<std::string_view>, 2> lists;
        for (std::size_t k = 0; k < taken_.size(); ++k) lists[taken_[k] ? 0 : 1].push_back(columns_.names[k]);
        std::string text = fmt::format("takes {}", one_line(fmt::to_string(fmt::join(lists[0], ", "))));
        if (!lists[1].empty())
            text += fmt::format("; passes over {}", one_line(fmt::to_string(fmt::join(lists[1], ", "))));
        return text;
    }

    void leave(std::size_t column) { taken_[column] = 0; }

private:
    const SphereColumns& columns_;
    std::map<std::string, std::size_t> at_; ///< by plain name
    std::vector<std::uint8_t> taken_;

    std::size_t take(std::size_t column)
    {
        taken_[column] = 1;
        return column;
    }
};

std::vector<double> numbers_of(const SphereColumns& columns, std::optional<std::size_t> column)
{
    std::vector<double> list;
    for (std::size_t i = 0; column && i < columns.rows; ++i) list.push_back(columns.number(i, *column));
    return list;
}

std::vector<Vec3> vectors_of(const SphereColumns& columns, const std::optional<std::array<std::size_t, 3>>& at)
{
    std::vector<Vec3> list;
    for (std::size_t i = 0; at && i < columns.rows; ++i)
        list.emplace_back(columns.number(i, (*at)[0]), columns.number(i, (*at)[1]), columns.number(i, (*at)[2]));
    return list;
}

/// The name of the material of each sphere; nothing where the column has numbers of which the scene has no material.
/// Types count from 1, as those of LAMMPS.
std::vector<std::string> materials_of(
    const SphereColumns& columns, std::size_t column, const std::vector<std::string>& materials)
{
    const int first = plain(columns.names[column]) == "type" ? 1 : 0;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < columns.rows; ++i) {
        const std::string text = columns.text(i, column);
        const auto number = finite_number(text);
        const bool is_number = number && std::ranges::find(materials, text) == materials.end();
        const double index = is_number ? *number - first : 0.0;
        if (is_number && !(index >= 0.0 && index < static_cast<double>(materials.size()))) return {};
        names.push_back(is_number ? materials[static_cast<std::size_t>(index)] : text);
    }
    return names;
}

template <class Element> void reorder(std::vector<Element>& list, const std::vector<std::size_t>& order)
{
    if (list.empty()) return;
    std::vector<Element> ordered;
    for (const std::size_t i : order) ordered.push_back(std::move(list[i]));
    list = std::move(ordered);
}

/// Refuses one that is there twice.
std::vector<std::size_t> order_of_ids(const SphereColumns& columns, const std::vector<double>& ids)
{
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return ids[i]; });
    for (std::size_t k = 1; k < order.size(); ++k)
        if (ids[order[k]] == ids[order[k - 1]])
            columns.refuse_row(order[k], fmt::format("two spheres have the id {}", ids[order[k]]));
    return order;
}

} // namespace

scene::SphereList spheres_of(const SphereColumns& columns, const std::vector<std::string>& materials)
{
    Finder finder(columns);
    scene::SphereList spheres;
    const auto position = finder.vector(position_names);
    if (!position) columns.refuse("the columns 'x', 'y' and 'z' are wanted");
    spheres.positions = vectors_of(columns, position);
    const auto radius = finder.number(radius_names), diameter = radius ? std::nullopt : finder.number(diameter_names);
    spheres.radii = numbers_of(columns, radius ? radius : diameter);
    for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
        if (diameter) spheres.radii[i] *= 0.5;
        if (!(spheres.radii[i] > 0.0))
            columns.refuse_row(i, fmt::format("the {} must be above 0", diameter ? "diameter" : "radius"));
    }
    spheres.velocities = vectors_of(columns, finder.vector(velocity_names));
    spheres.angular_velocities = vectors_of(columns, finder.vector(spin_names));
    if (const auto material = finder.number(material_names)) {
        spheres.materials = materials_of(columns, *material, materials);
        if (spheres.materials.empty()) finder.leave(*material);
    }
    if (const auto id = finder.number(id_names)) {
        const auto order = order_of_ids(columns, numbers_of(columns, id));
        reorder(spheres.positions, order);
        reorder(spheres.radii, order);
        reorder(spheres.velocities, order);
        reorder(spheres.angular_velocities, order);
        reorder(spheres.materials, order);
    }
    spheres.columns = finder.said();
    return spheres;
}

bool is_vector_of_spheres(std::string_view name)
{
    const std::string text = plain(name);
    return std::ranges::find(velocity_names, text) != velocity_names.end() ||
           std::ranges::find(spin_names, text) != spin_names.end();
}

bool is_number_of_spheres(std::string_view name)
{
    const std::string text = plain(name);
    return std::ranges::any_of(std::array{radius_names, diameter_names, id_names, material_names},
        [&](const Names& names) { return std::ranges::find(names, text) != names.end(); });
}

} // namespace talus
