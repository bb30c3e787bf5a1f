// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/materials.hpp"

#include "scenarios/builder/checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace talus
{
namespace
{

/// Which pairs of materials have a law.
using GivenPairs = std::vector<std::uint8_t>;

/// E* of two materials: 1/E* = (1 − ν_a²)/E_a + (1 − ν_b²)/E_b [Pa].
double contact_modulus(const scene::MaterialTable& a, const scene::MaterialTable& b)
{
    const auto softness = [](const scene::MaterialTable& material) {
        return (1.0 - material.poisson * material.poisson) / material.young_modulus;
    };
    return 1.0 / (softness(a) + softness(b));
}

/// Contacts are soft with `matched` alone.
void require_matched(const scene::Scene& scene, double softness, const std::string& key, const char* what)
{
    if (scene.solver.stabilisation == "projected" && std::isfinite(softness))
        throw SceneError(key, std::string("a ") + what +
                                  " goes with stabilisation \"matched\" only; with \"projected\" contacts are rigid");
}

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
    require_matched(scene, contact.stiffness, key_path("contact", index, "stiffness"), "stiffness");
    given[a * n + b] = given[b * n + a] = 1;
    const double modulus = contact_modulus(scene.materials[a], scene.materials[b]);
    materials.laws[a * n + b] =
        materials.laws[b * n + a] = {contact.friction, contact.restitution, contact.rolling_friction, contact.stiffness,
            contact.twisting_friction, std::isfinite(contact.stiffness) ? infinity : modulus};
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

/// What a table of cohesion says, but for its range.
Attraction attraction_of(const scene::CohesionTable& table)
{
    constexpr double pi = std::numbers::pi;
    if (table.law == "constant") return {.force = table.force};
    if (table.law == "dmt") return {.by_radius = 2.0 * pi * table.work_of_adhesion};
    if (table.law == "jkr") return {.by_radius = 1.5 * pi * table.work_of_adhesion};
    if (table.law == "bond_number") return {.by_weight = table.bond_number};
    return {.by_radius = 4.0 * pi * table.surface_tension * std::cos(table.contact_angle), .volume = table.volume};
}

} // namespace

void add_attractions(Model& model, const scene::Scene& scene)
{
    constexpr double usual_range = 0.01; // mean diameters: no sign of a rounded gap decides
    Materials& materials = model.materials;
    for (std::size_t k = 0; k < scene.contact.size(); ++k) {
        const auto& contact = scene.contact[k];
        const scene::CohesionTable& table = contact.cohesion;
        if (table.law == "none") continue;
        const std::string key = key_path("contact", k, "cohesion");
        Attraction law = attraction_of(table);
        if (law.force + law.by_radius + law.by_weight == 0.0) continue;
        if (table.law == "bond_number" && model.gravity.isZero())
            throw SceneError(key + ".bond_number", "a Bond number is a multiple of a weight, and there is no gravity");
        law.range = table.law == "liquid" ? (1.0 + 0.5 * table.contact_angle) * std::cbrt(table.volume)
                    : table.range > 0.0   ? table.range
                                          : usual_range * model.mean_diameter;
        if (law.range > 0.5 * model.min_diameter)
            throw SceneError(key + (table.law == "liquid" ? ".volume" : ".range"),
                "two would attract each other over a gap of more than half the smallest diameter, which is the most");
        materials.attractions.resize(materials.laws.size());
        const auto a = static_cast<std::size_t>(material_index(materials, contact.between[0], key));
        const auto b = static_cast<std::size_t>(material_index(materials, contact.between[1], key));
        const std::size_t n = materials.list.size();
        materials.attractions[a * n + b] = materials.attractions[b * n + a] = law;
        model.attraction_range = std::max(model.attraction_range, law.range);
    }
}

Materials build_materials(const scene::Scene& scene)
{
    Materials materials;
    for (const auto& material : scene.materials) {
        require_matched(scene, material.young_modulus, "materials." + material.name + ".young_modulus", "modulus");
        materials.list.push_back({material.name, material.density});
    }
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
