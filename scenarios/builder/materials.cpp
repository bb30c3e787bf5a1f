// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/materials.hpp"

#include "scenarios/builder/checks.hpp"

#include <cmath>
#include <map>
#include <set>

namespace talus
{
namespace
{

/// Which pairs of materials have a law.
using GivenPairs = std::vector<std::uint8_t>;

/// Reads the law of one [[contact]] into both of its places.
void add_law(Materials& materials, GivenPairs& given, const scene::Scene& scene, std::size_t index)
{
    const auto& contact = scene.contact[index];
    const auto key = key_path("contact", index, "between");
    if (contact.between.size() != 2)
        throw SceneError(key, "'between' names two materials, here are " + std::to_string(contact.between.size()));
    const auto n = materials.list.size();
    const auto a = static_cast<std::size_t>(material_index(materials, contact.between[0], key));
    const auto b = static_cast<std::size_t>(material_index(materials, contact.between[1], key));
    if (given[a * n + b])
        throw SceneError(
            key, "the contact of " + contact.between[0] + " and " + contact.between[1] + " is given twice");
    if (scene.solver.stabilisation == "projected" && std::isfinite(contact.stiffness))
        throw SceneError(key_path("contact", index, "stiffness"),
            "a stiffness goes with stabilisation \"matched\" only; with \"projected\" contacts are rigid");
    given[a * n + b] = given[b * n + a] = 1;
    materials.laws[a * n + b] = materials.laws[b * n + a] = {
        contact.friction, contact.restitution, contact.rolling_friction, contact.stiffness};
}

std::set<std::string> set_of(const std::vector<std::string>& names)
{
    return {names.begin(), names.end()};
}

/// How many spheres a fill or a pour can have at most.
double most_spheres(const scene::FillTable& fill)
{
    if (fill.arrangement == "single") return 1.0;
    if (fill.arrangement == "file") return static_cast<double>(fill.spheres.positions.size());
    return fill.mass > 0.0 || fill.filling > 0.0 ? infinity : static_cast<double>(fill.count);
}
double most_spheres(const scene::PourTable& pour)
{
    return pour.mass > 0.0 ? infinity : static_cast<double>(pour.count);
}

/// How many spheres of each material there can be at most.
std::map<std::string, double> count_spheres(const scene::Scene& scene)
{
    std::map<std::string, double> count;
    const auto add = [&](const auto& table) {
        for (const auto& name : set_of(materials_in(table))) count[name] += most_spheres(table);
    };
    for (const auto& fill : scene.fill) {
        if (fill.spheres.materials.empty()) add(fill);
        for (const auto& name : fill.spheres.materials) count[name] += 1.0;
    }
    for (const auto& pour : scene.pour) add(pour);
    return count;
}

/// Every pair that can meet must have a law: the materials of spheres with each other, of those of which there are two
/// with themselves, and with those of walls.
void require_laws(const Materials& materials, const GivenPairs& given, const scene::Scene& scene)
{
    const auto spheres = count_spheres(scene);
    std::set<std::string> of_walls;
    for (const auto& wall : scene.wall) of_walls.insert(wall.material);
    const auto can_touch = [&](const std::string& a, const std::string& b) {
        if (!spheres.contains(a)) return false;
        return of_walls.contains(b) || (a == b ? spheres.at(a) > 1.0 : spheres.contains(b));
    };
    const auto n = materials.list.size();
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) {
            const auto& name_a = materials.list[a].name;
            const auto& name_b = materials.list[b].name;
            if (can_touch(name_a, name_b) && !given[a * n + b])
                throw SceneError(
                    "contact", "no [[contact]] between " + name_a + " and " + name_b + ", which can touch");
        }
}

} // namespace

Materials build_materials(const scene::Scene& scene)
{
    Materials materials;
    for (const auto& material : scene.materials) materials.list.push_back({material.name, material.density});
    materials.laws.resize(materials.list.size() * materials.list.size());
    GivenPairs given(materials.laws.size(), 0);
    for (std::size_t k = 0; k < scene.contact.size(); ++k) add_law(materials, given, scene, k);
    require_laws(materials, given, scene);
    return materials;
}

int material_index(const Materials& materials, const std::string& name, const std::string& key)
{
    return static_cast<int>(index_of(materials.list, "material", name, key));
}

} // namespace talus
