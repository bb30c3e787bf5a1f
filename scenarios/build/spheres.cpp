// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/spheres.hpp"

#include "scenarios/build/checks.hpp"
#include "scenarios/build/materials.hpp"
#include "scenarios/build/mixture.hpp"
#include "scenarios/build/packing.hpp"
#include "scenarios/build/region.hpp"

#include <cmath>

namespace talus
{
namespace
{

void require_inside_world(const Region& region, double diameter, const Box& world, const std::string& key)
{
    constexpr double widest = 1e5; // diameters; a wider region is a slip of units, and would take for ever to fill
    if (!region.fits(0.5 * diameter)) throw SceneError(key, "the region is smaller than one sphere");
    if (region.bounds().extent().maxCoeff() > widest * diameter)
        throw SceneError(key, "the region is more than 100 000 spheres across");
    if (!world.contains(region.bounds()))
        throw SceneError(key, "the region reaches out of the world; see [world] min and max");
}

/// The spheres of a lattice or of a random packing.
std::vector<PackedSphere> packed_spheres(const scene::FillTable& table, const std::string& key, const Model& model,
    const std::vector<PackedSphere>& placed, Random& random)
{
    const auto mixture = build_mixture(table, key, model.materials);
    const auto region = build_region(table.region, key + ".region");
    require_inside_world(region, mixture.max_diameter(), model.world, key + ".region");
    const bool lattice = table.arrangement == "lattice";
    auto spheres = lattice ? lattice_packing(region, mixture, table.count, table.spacing, placed, model, random)
                           : random_packing(region, mixture, table.count, placed, model, random);
    if (static_cast<std::int64_t>(spheres.size()) < table.count)
        throw SceneError(key + ".region",
            "the region holds " + std::to_string(spheres.size()) +
                " spheres of this size clear of walls and earlier fills, not " + std::to_string(table.count) +
                (lattice ? "; make it larger, or lower 'count' or 'spacing'"
                         : "; make it larger, lower 'count', or use arrangement \"lattice\""));
    return spheres;
}

/// The spheres that a file lists.
std::vector<PackedSphere> listed_spheres(const scene::FillTable& table, const std::string& key, const Model& model)
{
    const auto& positions = table.spheres.positions;
    if (table.count != 0 && table.count != static_cast<std::int64_t>(positions.size()))
        throw SceneError(key + ".count", "the file has " + std::to_string(positions.size()) + " spheres, not " +
                                             std::to_string(table.count) + "; leave 'count' out to take them all");
    if (table.material.empty()) throw SceneError(key + ".material", "give the 'material' of the file's spheres");
    const int material = material_index(model.materials, table.material, key + ".material");
    const auto radii = radii_from_file(table, key);
    std::vector<PackedSphere> spheres;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!model.world.contains(positions[i]))
            throw SceneError(key + ".file",
                "sphere " + std::to_string(i) + " of the file lies outside of the world; see [world] min and max");
        spheres.push_back({positions[i], radii[i], material});
    }
    return spheres;
}

/// Element i of a list of the file's that may be missing.
Vec3 listed(const std::vector<Vec3>& list, std::size_t i)
{
    return list.empty() ? Vec3::Zero() : list[i];
}

void fill(Simulation& simulation, const scene::FillTable& table, const std::string& key, Random& random,
    std::vector<PackedSphere>& placed)
{
    const auto& model = simulation.model;
    const auto spheres = table.arrangement == "file" ? listed_spheres(table, key, model)
                                                     : packed_spheres(table, key, model, placed, random);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const auto& s = spheres[i];
        add_sphere(simulation.state, s.center, s.radius,
            model.materials.list[static_cast<std::size_t>(s.material)].density, s.material,
            table.velocity + listed(table.spheres.velocities, i),
            table.angular_velocity + listed(table.spheres.angular_velocities, i));
    }
    placed.insert(placed.end(), spheres.begin(), spheres.end());
}

/// @param name of a key, @param other that which may stand for it
void require_one(double value, double other, const std::string& key, const std::string& name, const std::string& both)
{
    if (value > 0.0 && other > 0.0) throw SceneError(key + "." + name, "give " + both + ", not both of them");
    if (!(value > 0.0) && !(other > 0.0))
        throw SceneError(key + "." + name, "a pour needs " + both + ", greater than 0");
}

Pour build_pour(const scene::PourTable& table, std::size_t index, const Model& model, std::uint64_t seed)
{
    const auto key = table_path("pour", index);
    Pour pour = build_source(table, key, model.materials);
    pour.name = table.name.empty() ? "pour " + std::to_string(index) : table.name;
    pour.region = build_region(table.region, key + ".region");
    require_inside_world(pour.region, pour.mixture.max_diameter(), model.world, key + ".region");
    pour.velocity = table.velocity;
    pour.start = table.start;
    pour.random.seed(seed);
    return pour;
}

} // namespace

Pour build_source(const scene::PourTable& table, const std::string& key, const Materials& materials)
{
    require_one(static_cast<double>(table.count), table.mass, key, "count", "'count' or 'mass'");
    require_one(table.rate, table.mass_rate, key, "rate", "'rate' or 'mass_rate'");
    Pour pour;
    pour.mixture = build_mixture(table, key, materials);
    if (table.count > 0) pour.count = table.count;
    if (table.mass > 0.0) pour.mass = table.mass;
    if (table.rate > 0.0) pour.rate = table.rate;
    if (table.mass_rate > 0.0) pour.mass_rate = table.mass_rate;
    constexpr double most = 1e8; // as for a count
    if (!(expected_count(pour, materials) <= most))
        throw SceneError(key + ".mass", "this mass is that of more than 100 million spheres");
    return pour;
}

std::vector<double> radii_from_file(const scene::FillTable& table, const std::string& key)
{
    const auto& listed = table.spheres;
    if (listed.positions.empty()) throw SceneError(key + ".file", "the fill needs a file with spheres");
    if (!listed.radii.empty()) {
        if (table.diameter.given())
            throw SceneError(key + ".diameter", "the file has the radii of its spheres: leave 'diameter' out");
        return listed.radii;
    }
    if (table.diameter.distribution != "constant" || !(table.diameter.value > 0.0))
        throw SceneError(key + ".diameter", "the file has no radius or diameter: give 'diameter' as a number");
    return std::vector<double>(listed.positions.size(), 0.5 * table.diameter.value);
}

void fill_spheres(Simulation& simulation, const scene::Scene& scene, Random& random)
{
    std::vector<PackedSphere> placed;
    for (std::size_t k = 0; k < scene.fill.size(); ++k)
        fill(simulation, scene.fill[k], table_path("fill", k), random, placed);
}

std::vector<Pour> build_pours(const scene::Scene& scene, const Model& model, Random& random)
{
    std::vector<Pour> pours;
    for (std::size_t k = 0; k < scene.pour.size(); ++k) pours.push_back(build_pour(scene.pour[k], k, model, random()));
    return pours;
}

} // namespace talus
