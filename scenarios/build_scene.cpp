// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build_scene.hpp"

#include "core/mass_flow.hpp"
#include "core/repose.hpp"
#include "scenarios/packing.hpp"
#include "scenarios/step_choice.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace talus
{
namespace
{

std::string entry(const char* list, std::size_t index, const char* key)
{
    return std::string(list) + "[" + std::to_string(index) + "]." + key;
}

// ---- materials

int material_index(const Materials& materials, const std::string& name, const std::string& key)
{
    std::string known;
    for (std::size_t k = 0; k < materials.list.size(); ++k) {
        if (materials.list[k].name == name) return static_cast<int>(k);
        known += (k ? ", " : "") + materials.list[k].name;
    }
    throw SceneError(key, "unknown material '" + name + "'; the scene has " + (known.empty() ? "none" : known));
}

Materials build_materials(const scene::Scene& scene)
{
    Materials materials;
    for (const auto& m : scene.materials) materials.list.push_back({m.name, m.density});
    const auto n = materials.list.size();
    materials.laws.resize(n * n);
    std::vector<std::uint8_t> given(n * n, 0);
    for (std::size_t k = 0; k < scene.contact.size(); ++k) {
        const auto& c = scene.contact[k];
        const auto key = entry("contact", k, "between");
        if (c.between.size() != 2)
            throw SceneError(key, "'between' names two materials, here are " + std::to_string(c.between.size()));
        const auto a = static_cast<std::size_t>(material_index(materials, c.between[0], key));
        const auto b = static_cast<std::size_t>(material_index(materials, c.between[1], key));
        if (given[a * n + b])
            throw SceneError(key, "the contact of " + c.between[0] + " and " + c.between[1] + " is given twice");
        if (scene.solver.stabilisation == "projected" && std::isfinite(c.stiffness))
            throw SceneError(entry("contact", k, "stiffness"),
                "a stiffness goes with stabilisation \"matched\" only; with \"projected\" contacts are rigid");
        given[a * n + b] = given[b * n + a] = 1;
        materials.laws[a * n + b] =
            materials.laws[b * n + a] = {c.friction, c.restitution, c.rolling_friction, c.stiffness};
    }
    // Every pair that can meet must have a law: sphere materials with each other and with those of walls.
    std::set<std::string> of_spheres, of_all;
    for (const auto& f : scene.fill) of_spheres.insert(f.material);
    for (const auto& p : scene.pour) of_spheres.insert(p.material);
    of_all = of_spheres;
    for (const auto& w : scene.wall) of_all.insert(w.material);
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
            if (of_spheres.count(materials.list[a].name) && of_all.count(materials.list[b].name) && !given[a * n + b])
                throw SceneError("contact", "no [[contact]] between " + materials.list[a].name + " and " +
                                                materials.list[b].name + ", which can touch");
    return materials;
}

// ---- shapes

Vec3 unit(const Vec3& v, const std::string& key)
{
    if (v.isZero()) throw SceneError(key, "a direction must not be zero");
    return v.normalized();
}

void require_positive(double value, const std::string& key, const std::string& what)
{
    if (!(value > 0.0) || !std::isfinite(value)) throw SceneError(key, what + " must be given, and greater than 0");
}

Box require_box(const Vec3& min, const Vec3& max, const std::string& key)
{
    if (!((min.array() < max.array()).all()))
        throw SceneError(key, "the box is empty: every coordinate of 'min' must be below that of 'max'");
    return {min, max};
}

Region build_region(const scene::RegionTable& table, const std::string& key)
{
    Region region;
    if (table.shape == "box") {
        region.box = require_box(table.min, table.max, key + ".max");
        return region;
    }
    require_positive(table.radius, key + ".radius", "the radius of a cylinder");
    require_positive(table.height, key + ".height", "the height of a cylinder");
    region.shape = Region::Shape::cylinder;
    region.base = table.base;
    region.axis = unit(table.axis, key + ".axis");
    region.radius = table.radius;
    region.height = table.height;
    return region;
}

Shape build_shape(const scene::WallTable& w, std::size_t index)
{
    const auto key = [&](const char* name) { return entry("wall", index, name); };
    if (w.shape == "plane") return Plane{w.point, unit(w.normal, key("normal"))};
    if (w.shape == "box") return box_panels(require_box(w.min, w.max, key("max")), w.open);
    if (w.shape == "disk") {
        require_positive(w.radius, key("radius"), "the radius of a disk");
        if (w.hole_radius >= w.radius) throw SceneError(key("hole_radius"), "the hole must be smaller than the disk");
        return Disk{w.center, unit(w.normal, key("normal")), w.radius, w.hole_radius};
    }
    if (w.shape == "mesh") {
        if (w.triangles.empty())
            throw SceneError(key("mesh"), "a wall of shape \"mesh\" needs an STL file with triangles");
        return make_mesh(w.vertices, w.triangles);
    }
    require_positive(w.height, key("height"), "the height of a " + w.shape);
    const Vec3 axis = unit(w.axis, key("axis"));
    if (w.shape == "cylinder") {
        require_positive(w.radius, key("radius"), "the radius of a cylinder");
        return Cylinder{w.base, axis, w.radius, w.height};
    }
    require_positive(std::max(w.base_radius, w.top_radius), key("base_radius"), "one of the radii of a cone");
    return Cone{w.base, axis, w.base_radius, w.top_radius, w.height};
}

std::vector<Wall> build_walls(const scene::Scene& scene, const Materials& materials)
{
    std::vector<Wall> walls;
    for (std::size_t k = 0; k < scene.wall.size(); ++k) {
        const auto& w = scene.wall[k];
        const int material = material_index(materials, w.material, entry("wall", k, "material"));
        walls.push_back({w.name, build_shape(w, k), material, w.appear_at, w.remove_at});
    }
    return walls;
}

// ---- spheres

SizeDistribution build_sizes(const scene::DiameterTable& d, const std::string& key)
{
    if (d.distribution == "constant") {
        require_positive(d.value, key + ".value", "the diameter");
        return {d.value, d.value};
    }
    require_positive(d.min, key + ".min", "the smallest diameter");
    if (!(d.max >= d.min) || !std::isfinite(d.max))
        throw SceneError(key + ".max", "the largest diameter must not be below the smallest");
    return {d.min, d.max};
}

void fill(Simulation& simulation, const scene::FillTable& table, std::size_t index, Random& random,
    std::vector<PackedSphere>& placed)
{
    const auto key = [&](const char* name) { return entry("fill", index, name); };
    const auto& materials = simulation.model.materials;
    const int material = material_index(materials, table.material, key("material"));
    const auto region = build_region(table.region, key("region"));
    const auto sizes = build_sizes(table.diameter, key("diameter"));
    if (!region.fits(0.5 * sizes.max)) throw SceneError(key("region"), "the region is smaller than one sphere");
    const bool lattice = table.arrangement == "lattice";
    const auto spheres = lattice ? lattice_packing(region, sizes, table.count, table.spacing, simulation.model, random)
                                 : random_packing(region, sizes, table.count, placed, simulation.model, random);
    if (static_cast<std::int64_t>(spheres.size()) < table.count)
        throw SceneError(
            key("region"), "the region holds " + std::to_string(spheres.size()) +
                               " spheres of this size clear of the walls, not " + std::to_string(table.count) +
                               (lattice ? "; make it larger, or lower 'count' or 'spacing'"
                                        : "; make it larger, lower 'count', or use arrangement \"lattice\""));
    for (const auto& s : spheres)
        add_sphere(simulation.state, s.center, s.radius, materials.list[static_cast<std::size_t>(material)].density,
            material, table.velocity, table.angular_velocity);
    placed.insert(placed.end(), spheres.begin(), spheres.end());
}

Pour build_pour(const scene::PourTable& table, std::size_t index, const Materials& materials, std::uint64_t seed)
{
    const auto key = [&](const char* name) { return entry("pour", index, name); };
    Pour pour;
    pour.name = table.name.empty() ? "pour " + std::to_string(index) : table.name;
    pour.region = build_region(table.region, key("region"));
    pour.diameter = build_sizes(table.diameter, key("diameter"));
    if (!pour.region.fits(0.5 * pour.diameter.max))
        throw SceneError(key("region"), "the region is smaller than one sphere");
    pour.material = material_index(materials, table.material, key("material"));
    pour.rate = table.rate;
    pour.count = table.count;
    pour.velocity = table.velocity;
    pour.start = table.start;
    pour.random.seed(seed);
    return pour;
}

// ---- model

/// Smallest, largest and mean diameter of all spheres that the scene makes.
void find_diameters(Model& model, const scene::Scene& scene)
{
    double sum = 0.0, count = 0.0;
    model.min_diameter = infinity;
    const auto add = [&](const SizeDistribution& sizes, std::int64_t number) {
        if (number == 0) return;
        model.min_diameter = std::min(model.min_diameter, sizes.min);
        model.max_diameter = std::max(model.max_diameter, sizes.max);
        sum += sizes.mean() * static_cast<double>(number);
        count += static_cast<double>(number);
    };
    for (std::size_t k = 0; k < scene.fill.size(); ++k)
        add(build_sizes(scene.fill[k].diameter, entry("fill", k, "diameter")), scene.fill[k].count);
    for (std::size_t k = 0; k < scene.pour.size(); ++k)
        add(build_sizes(scene.pour[k].diameter, entry("pour", k, "diameter")), scene.pour[k].count);
    if (count == 0.0)
        throw SceneError("fill", "the scene has no spheres: give a [[fill]] or a [[pour]] with a count above 0");
    model.mean_diameter = sum / count;
}

/// The box of walls, fills, pours and outlets, grown by five diameters and open upwards, where the scene does not say.
Box build_world(const scene::Scene& scene, const Model& model)
{
    if (!((scene.world.min.array() < scene.world.max.array()).all()))
        throw SceneError("world.max", "the world is empty: every coordinate of 'min' must be below that of 'max'");
    Box box;
    for (const auto& wall : model.walls)
        if (const Box b = bounds(wall.shape); !b.empty()) box.extend(b);
    for (std::size_t k = 0; k < scene.fill.size(); ++k)
        box.extend(build_region(scene.fill[k].region, entry("fill", k, "region")).bounds());
    for (std::size_t k = 0; k < scene.pour.size(); ++k)
        box.extend(build_region(scene.pour[k].region, entry("pour", k, "region")).bounds());
    for (const auto& outlet : model.outlets) box.extend(outlet.bounds());
    box = box.grown(5.0 * model.max_diameter);
    for (int d = 0; d < 3; ++d) {
        if (model.gravity[d] < 0.0) box.max[d] = infinity;
        if (model.gravity[d] > 0.0) box.min[d] = -infinity;
        if (std::isfinite(scene.world.min[d])) box.min[d] = scene.world.min[d];
        if (std::isfinite(scene.world.max[d])) box.max[d] = scene.world.max[d];
    }
    return box;
}

double tolerance(const scene::NumberOrName& value)
{
    if (value.name == "draft") return 5e-2;
    if (value.name == "standard") return 1e-2;
    if (value.name == "fine") return 1e-3;
    if (value.name == "reference") return 1e-4;
    return value.number;
}

SolverSettings build_solver(const scene::Scene& scene, const Model& model)
{
    const auto& table = scene.solver;
    SolverSettings solver;
    solver.stabilisation = table.stabilisation == "matched" ? Stabilisation::matched : Stabilisation::projected;
    solver.min_sweeps = table.min_sweeps > 0                             ? static_cast<int>(table.min_sweeps)
                        : solver.stabilisation == Stabilisation::matched ? 2
                                                                         : 3;
    solver.max_sweeps = static_cast<int>(table.max_sweeps);
    if (solver.max_sweeps < solver.min_sweeps)
        throw SceneError("solver.max_sweeps",
            "'max_sweeps' must be at least the " + std::to_string(solver.min_sweeps) + " of 'min_sweeps'");
    solver.tolerance = tolerance(table.tolerance);
    solver.restitution_threshold = table.restitution_threshold;
    const double gravity = model.gravity.norm();
    const double automatic = gravity > 0.0 ? 0.1 * std::sqrt(model.mean_diameter * gravity) : infinity;
    solver.push_out_speed = table.push_out_speed.name == "auto" ? automatic : table.push_out_speed.number;
    return solver;
}

ModelledPhysics needed_physics(const Materials& materials)
{
    ModelledPhysics physics;
    for (const auto& law : materials.laws) {
        physics.friction = physics.friction || law.friction > 0.0 || law.rolling_friction > 0.0;
        physics.rolling = physics.rolling || law.rolling_friction > 0.0;
        physics.restitution = physics.restitution || law.restitution > 0.0;
    }
    return physics;
}

std::string explain_model(const Model& model)
{
    const auto& p = model.physics;
    const bool meshes = std::any_of(
        model.walls.begin(), model.walls.end(), [](const Wall& w) { return std::holds_alternative<Mesh>(w.shape); });
    std::string models = "models contact", leaves_out;
    const auto say = [&](bool needed, const char* what) {
        auto& list = needed ? models : leaves_out;
        list += (list.empty() ? "" : ", ") + std::string(what);
    };
    say(p.friction, "friction and spin");
    say(p.rolling, "rolling resistance");
    say(p.restitution, "restitution");
    say(meshes, "mesh walls");
    say(!model.outlets.empty(), "outlets");
    return models + (leaves_out.empty() ? "" : "; leaves out " + leaves_out);
}

void build_sensors(Simulation& simulation, const scene::Scene& scene)
{
    std::set<std::string> names;
    for (std::size_t k = 0; k < scene.sensor.size(); ++k) {
        const auto& s = scene.sensor[k];
        if (!names.insert(s.name).second)
            throw SceneError(entry("sensor", k, "name"), "two sensors are called '" + s.name + "'");
        if (s.kind == "mass_flow") {
            if (!(s.to > s.from)) throw SceneError(entry("sensor", k, "to"), "'to' must be later than 'from'");
            simulation.sensors.push_back(std::make_unique<MassFlow>(
                s.name, s.point, unit(s.normal, entry("sensor", k, "normal")), s.from, s.to));
        } else {
            if (simulation.model.gravity.isZero())
                throw SceneError(entry("sensor", k, "kind"), "an angle of repose needs gravity");
            if (s.outer_radius > 0.0 && s.outer_radius <= s.inner_radius)
                throw SceneError(entry("sensor", k, "outer_radius"), "'outer_radius' must be above 'inner_radius'");
            simulation.sensors.push_back(std::make_unique<Repose>(s.name, s.base, s.inner_radius, s.outer_radius));
        }
    }
}

} // namespace

Simulation build_scene(const scene::Scene& scene)
{
    Simulation simulation;
    auto& model = simulation.model;
    model.gravity = scene.world.gravity;
    model.materials = build_materials(scene);
    model.physics = needed_physics(model.materials);
    model.walls = build_walls(scene, model.materials);
    for (std::size_t k = 0; k < scene.outlet.size(); ++k)
        model.outlets.push_back(build_region(scene.outlet[k].region, entry("outlet", k, "region")));
    find_diameters(model, scene);
    model.world = build_world(scene, model);
    model.solver = build_solver(scene, model);

    Random random(static_cast<std::uint64_t>(scene.seed));
    std::vector<PackedSphere> placed;
    for (std::size_t k = 0; k < scene.fill.size(); ++k) fill(simulation, scene.fill[k], k, random, placed);
    for (std::size_t k = 0; k < scene.pour.size(); ++k)
        simulation.pours.push_back(build_pour(scene.pour[k], k, model.materials, random()));

    const auto choice = choose_step(scene, simulation);
    model.time_step = choice.step;
    model.speed_limit = 10.0 * choice.fastest_speed + model.min_diameter / choice.step;
    simulation.step_explanation = choice.explanation;
    simulation.model_explanation = explain_model(model);
    simulation.overlap_forecast = forecast_overlap(simulation);
    simulation.duration = scene.time.duration;
    build_sensors(simulation, scene);
    return simulation;
}

} // namespace talus
