// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build_spheres.hpp"

#include "scenarios/build_materials.hpp"
#include "scenarios/build_region.hpp"
#include "scenarios/packing.hpp"
#include "scenarios/scene_checks.hpp"

#include <cmath>

namespace talus
{
namespace
{

void require_inside_world(const Region& region, const SizeDistribution& sizes, const Box& world, const std::string& key)
{
    constexpr double widest = 1e5; // diameters; a wider region is a slip of units, and would take for ever to fill
    if (region.bounds().extent().maxCoeff() > widest * sizes.max)
        throw SceneError(key, "the region is more than 100 000 spheres across");
    if (!world.contains(region.bounds()))
        throw SceneError(key, "the region reaches out of the world; see [world] min and max");
}

void fill(Simulation& simulation, const scene::FillTable& table, std::size_t index, Random& random,
    std::vector<PackedSphere>& placed)
{
    const auto key = [&](const char* name) { return key_path("fill", index, name); };
    const auto& materials = simulation.model.materials;
    const int material = material_index(materials, table.material, key("material"));
    const auto region = build_region(table.region, key("region"));
    const auto sizes = build_sizes(table.diameter, key("diameter"));
    if (!region.fits(0.5 * sizes.max)) throw SceneError(key("region"), "the region is smaller than one sphere");
    require_inside_world(region, sizes, simulation.model.world, key("region"));
    const bool lattice = table.arrangement == "lattice";
    const auto spheres =
        lattice ? lattice_packing(region, sizes, table.count, table.spacing, placed, simulation.model, random)
                : random_packing(region, sizes, table.count, placed, simulation.model, random);
    if (static_cast<std::int64_t>(spheres.size()) < table.count)
        throw SceneError(key("region"),
            "the region holds " + std::to_string(spheres.size()) +
                " spheres of this size clear of walls and earlier fills, not " + std::to_string(table.count) +
                (lattice ? "; make it larger, or lower 'count' or 'spacing'"
                         : "; make it larger, lower 'count', or use arrangement \"lattice\""));
    for (const auto& s : spheres)
        add_sphere(simulation.state, s.center, s.radius, materials.list[static_cast<std::size_t>(material)].density,
            material, table.velocity, table.angular_velocity);
    placed.insert(placed.end(), spheres.begin(), spheres.end());
}

Pour build_pour(const scene::PourTable& table, std::size_t index, const Model& model, std::uint64_t seed)
{
    const auto key = [&](const char* name) { return key_path("pour", index, name); };
    Pour pour;
    pour.name = table.name.empty() ? "pour " + std::to_string(index) : table.name;
    pour.region = build_region(table.region, key("region"));
    pour.diameter = build_sizes(table.diameter, key("diameter"));
    if (!pour.region.fits(0.5 * pour.diameter.max))
        throw SceneError(key("region"), "the region is smaller than one sphere");
    require_inside_world(pour.region, pour.diameter, model.world, key("region"));
    pour.material = material_index(model.materials, table.material, key("material"));
    pour.rate = table.rate;
    pour.count = table.count;
    pour.velocity = table.velocity;
    pour.start = table.start;
    pour.random.seed(seed);
    return pour;
}

} // namespace

SizeDistribution build_sizes(const scene::DiameterTable& table, const std::string& key)
{
    if (table.distribution == "constant") {
        require_positive(table.value, key + ".value", "the diameter");
        return {table.value, table.value};
    }
    require_positive(table.min, key + ".min", "the smallest diameter");
    if (!(table.max >= table.min) || !std::isfinite(table.max))
        throw SceneError(key + ".max", "the largest diameter must not be below the smallest");
    return {table.min, table.max};
}

void fill_spheres(Simulation& simulation, const scene::Scene& scene, Random& random)
{
    std::vector<PackedSphere> placed;
    for (std::size_t k = 0; k < scene.fill.size(); ++k) fill(simulation, scene.fill[k], k, random, placed);
}

std::vector<Pour> build_pours(const scene::Scene& scene, const Model& model, Random& random)
{
    std::vector<Pour> pours;
    for (std::size_t k = 0; k < scene.pour.size(); ++k) pours.push_back(build_pour(scene.pour[k], k, model, random()));
    return pours;
}

} // namespace talus
