// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/deck_basis.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <set>

namespace talus
{
namespace
{

constexpr double least_modulus = 5e6;         ///< which LIGGGHTS asks for [Pa]
constexpr double modulus_by_pressure = 500.0; ///< at which a bed's mean overlap is about one percent of a diameter
constexpr double grain_weight = 1e6; ///< of grains of walls, so that a sphere feels something that does not give way

AtomTypes atom_types(const Simulation& simulation)
{
    AtomTypes types;
    const Model& model = simulation.model;
    for (std::size_t k = 0; k < model.materials.list.size(); ++k) types.material.push_back(static_cast<int>(k));
    for (std::size_t k = 0; k < model.walls.size(); ++k)
        if (std::holds_alternative<Grains>(model.walls[k].shape)) {
            types.grain_walls.push_back(k);
            types.material.push_back(model.walls[k].material);
        }
    std::set<int> materials(simulation.state.material.begin(), simulation.state.material.end());
    for (const Pour& pour : simulation.pours)
        for (const Species& species : pour.mixture.species) materials.insert(species.material);
    for (const int material : materials) types.moving.push_back(material + 1);
    return types;
}

/// The world, which is without end where nothing bounds it, cut off at a distance there.
Box room(const Model& model)
{
    const double far = 0.5 * model.contents.extent().maxCoeff() + 5.0 * model.max_diameter;
    Box box = model.contents.grown(far);
    for (int d = 0; d < 3; ++d) {
        if (std::isfinite(model.world.min[d])) box.min[d] = model.world.min[d];
        if (std::isfinite(model.world.max[d])) box.max[d] = model.world.max[d];
        if (!model.periodicity.along(d)) continue;
        box.min[d] = model.periodicity.origin[d];
        box.max[d] = model.periodicity.origin[d] + model.periodicity.length[d];
    }
    return box;
}

/// The modulus that gives the deck's contacts, of Poisson's ratio `poisson`, this E* [Pa].
double of_equal_spheres(double contact_modulus)
{
    return 2.0 * (1.0 - poisson * poisson) * contact_modulus;
}

/// The greatest E* of the scene's materials, infinite where none has a modulus [Pa].
double greatest_modulus(const Model& model)
{
    double greatest = 0.0;
    for (const ContactLaw& law : model.materials.laws)
        if (std::isfinite(law.modulus)) greatest = std::max(greatest, law.modulus);
    return greatest > 0.0 ? greatest : infinity;
}

/// That of the materials; where they have none, stiff enough for the spheres to lie on each other as high as they do at
/// the start.
double modulus(const Simulation& simulation)
{
    const Model& model = simulation.model;
    if (model.physics.elasticity) return of_equal_spheres(greatest_modulus(model));
    double lowest = infinity, highest = -infinity, density = 0.0;
    for (const Vec3& x : simulation.state.position) {
        lowest = std::min(lowest, x.dot(model.up()));
        highest = std::max(highest, x.dot(model.up()));
    }
    for (const Material& material : model.materials.list) density = std::max(density, material.density);
    if (lowest > highest) return least_modulus;
    const double wanted = modulus_by_pressure * density * model.gravity.norm() * (highest - lowest);
    if (wanted <= least_modulus) return least_modulus;
    const double digit = std::pow(10.0, std::floor(std::log10(wanted)) - 1.0);
    return std::ceil(wanted / digit) * digit;
}

const char* axis_name(int axis)
{
    constexpr std::array<const char*, 3> names = {"x", "y", "z"};
    return names[static_cast<std::size_t>(axis)];
}

/// Spheres by id, as a sweep leaves them in another order.
std::vector<std::size_t> by_id(const State& state)
{
    std::vector<std::size_t> order(state.count());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return state.id[i]; });
    return order;
}

std::string words(const Vec3& v)
{
    return fmt::format("{:.10g} {:.10g} {:.10g}", v.x(), v.y(), v.z());
}

/// A commented list of sentences, broken at 100 characters.
std::string as_comment(const ExportNotes& notes)
{
    std::string text;
    for (const std::string& note : notes) {
        std::string line = "#  -";
        std::size_t begin = 0;
        while (begin < note.size()) {
            const std::size_t end = std::min(note.find(' ', begin), note.size());
            if (line.size() + end - begin > 100) {
                text += line + "\n";
                line = "#   ";
            }
            line += " " + note.substr(begin, end - begin);
            begin = end + 1;
        }
        text += line + "\n";
    }
    return text;
}

} // namespace

DeckBasis deck_basis(const scene::Scene& scene, const Simulation& simulation)
{
    if (simulation.model.physics.twisting)
        throw InputError("the scene has twisting_friction, which decks do not write: set it to 0");
    return {scene, simulation, atom_types(simulation), room(simulation.model), modulus(simulation)};
}

std::string deck_id(const char* kind, std::size_t index, const std::string& name)
{
    std::string id = fmt::format("{}{}", kind, index);
    if (!name.empty()) id += "_";
    for (const char c : name) id += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return id;
}

std::string data_file(const DeckBasis& basis)
{
    const State& state = basis.simulation.state;
    const Model& model = basis.simulation.model;
    fmt::memory_buffer atoms, velocities;
    std::int64_t id = 0;
    for (const std::size_t i : by_id(state)) {
        ++id;
        const int type = state.material[i] + 1;
        fmt::format_to(std::back_inserter(atoms), "{} {} {:.10g} {:.10g} {}\n", id, type, 2.0 * state.radius[i],
            model.materials.list[static_cast<std::size_t>(state.material[i])].density, words(state.position[i]));
        fmt::format_to(std::back_inserter(velocities), "{} {} {}\n", id, words(state.body(i).velocity),
            words(state.angular_velocity(i)));
    }
    for (std::size_t k = 0; k < basis.types.grain_walls.size(); ++k) {
        const Wall& wall = model.walls[basis.types.grain_walls[k]];
        const auto& grains = std::get<Grains>(wall.shape);
        const double density = grain_weight * model.materials.list[static_cast<std::size_t>(wall.material)].density;
        for (const Vec3& center : grains.centers) {
            fmt::format_to(std::back_inserter(atoms), "{} {} {:.10g} {:.10g} {}\n", ++id,
                model.materials.list.size() + 1 + k, 2.0 * grains.radius, density, words(center));
            fmt::format_to(std::back_inserter(velocities), "{} 0 0 0 0 0 0\n", id);
        }
    }
    std::string text = fmt::format("Spheres by id\n\n{} atoms\n{} atom types\n\n", id, basis.types.material.size());
    for (int d = 0; d < 3; ++d)
        text +=
            fmt::format("{:.10g} {:.10g} {}lo {}hi\n", basis.box.min[d], basis.box.max[d], axis_name(d), axis_name(d));
    text += fmt::format("\nAtoms\n\n{}", fmt::to_string(atoms));
    if (velocities.size() > 0) text += fmt::format("\nVelocities\n\n{}", fmt::to_string(velocities));
    return text;
}

std::vector<SizeClass> size_classes(const Mixture& mixture)
{
    constexpr std::size_t classes = 8, in_a_class = 1000;
    std::vector<SizeClass> list;
    for (const Species& species : mixture.species) {
        if (species.diameter.min == species.diameter.max) {
            list.push_back({species.diameter.min, species.material, species.number});
            continue;
        }
        Random random(1);
        std::vector<double> diameters;
        for (std::size_t k = 0; k < classes * in_a_class; ++k) diameters.push_back(species.diameter.draw(random));
        std::ranges::sort(diameters);
        for (std::size_t k = 0; k < classes; ++k) {
            double cubes = 0.0;
            for (std::size_t j = 0; j < in_a_class; ++j) cubes += std::pow(diameters[k * in_a_class + j], 3);
            list.push_back({std::cbrt(cubes / in_a_class), species.material, species.number / classes});
        }
    }
    return list;
}

std::optional<AxisWords> along_axis(const Vec3& base, const Vec3& direction)
{
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    if (std::abs(direction[axis]) < 1.0 - 1e-12) return std::nullopt;
    std::string text = axis_name(axis);
    for (int d = 0; d < 3; ++d)
        if (d != axis) text += fmt::format(" {:.10g}", base[d]);
    return AxisWords{axis, text};
}

std::string box_words(const Box& box)
{
    const Vec3 &min = box.min, &max = box.max;
    return fmt::format(
        "block {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g}", min.x(), max.x(), min.y(), max.y(), min.z(), max.z());
}

std::optional<std::string> region_words(const Region& region)
{
    if (region.shape == Region::Shape::box) return box_words(region.box);
    if (region.shape == Region::Shape::sphere)
        return fmt::format("sphere {} {:.10g}", words(region.base), region.radius);
    const auto placed = along_axis(region.base, region.axis);
    if (!placed || region.shape == Region::Shape::inside) return std::nullopt;
    double first = region.base[placed->axis], second = first + region.height * region.axis[placed->axis];
    if (region.shape == Region::Shape::cylinder)
        return fmt::format("cylinder {} {:.10g} {:.10g} {:.10g}", placed->words, region.radius, std::min(first, second),
            std::max(first, second));
    double low = region.radius, high = region.top_radius;
    if (first > second) {
        std::swap(first, second);
        std::swap(low, high);
    }
    return fmt::format("cone {} {:.10g} {:.10g} {:.10g} {:.10g}", placed->words, low, high, first, second);
}

bool comes_or_goes(const Wall& wall, double duration)
{
    return wall.appear_at > 0.0 || wall.remove_at < duration;
}

std::string deck_head(const DeckBasis& basis, const DeckOrigin& origin, const ExportNotes& notes)
{
    std::string text = fmt::format("# {}\n# The scene {} of Talus {}; SI units. To be run in this folder: {}\n#\n",
        basis.scene.title, origin.scene, origin.version, deck_command(origin.program));
    text += "# Contacts are springs here: Hertz and Mindlin, damped as the restitution asks. A larger modulus makes\n"
            "# overlaps smaller and steps shorter: -var modulus 5e7. A step is a fifth of Rayleigh's time.\n";
    if (!notes.empty()) text += "#\n# Not, or not quite, as in Talus:\n" + as_comment(notes);
    return text;
}

std::string deck_room(const DeckBasis& basis)
{
    const Model& model = basis.simulation.model;
    double density = infinity;
    for (const int type : basis.types.moving)
        density = std::min(density, model.materials.list[static_cast<std::size_t>(type - 1)].density);
    std::string text;
    const bool empty = basis.simulation.state.count() == 0 && basis.types.grain_walls.empty();
    if (empty)
        text += fmt::format(
            "region room {} units box\ncreate_box {} room\n", box_words(basis.box), basis.types.material.size());
    else
        text += fmt::format("read_data {}\n", spheres_file);
    // Lists take long where a sphere reaches over many: there they are made to last.
    const double skin = std::clamp(0.1 * model.max_diameter, 0.2 * model.mean_diameter, model.mean_diameter);
    text += fmt::format("neighbor {:.4g} bin\nneigh_modify delay 0{}\n", skin,
        model.max_diameter > 3.0 * model.min_diameter ? " page 2000000 one 20000" : "");
    text += fmt::format("\nvariable modulus index {:.4g}\n"
                        "variable step equal 0.2*PI*{:.6g}*sqrt({:.6g}*2*(1+{})/${{modulus}})/(0.1631*{}+0.8766)\n"
                        "timestep ${{step}}\nvariable t equal step*${{step}}\n",
        basis.modulus, 0.5 * model.min_diameter, density, poisson, poisson, poisson);
    for (const int type : basis.types.moving) text += fmt::format("group {} type {}\n", type_group(basis, type), type);
    return text;
}

std::string type_group(const DeckBasis& basis, int type)
{
    return deck_id("grains", static_cast<std::size_t>(type),
        basis.simulation.model.materials.list[static_cast<std::size_t>(type - 1)].name);
}

std::string deck_motion(const DeckBasis& basis)
{
    std::string text;
    const Vec3& gravity = basis.simulation.model.gravity;
    if (gravity.norm() > 0.0)
        text += fmt::format("fix weight all gravity {:.10g} vector {}\n", gravity.norm(), words(gravity.normalized()));
    const char* style = basis.scene.world.rotation ? "nve/sphere" : "nve";
    for (const int type : basis.types.moving)
        text += fmt::format("fix motion{} {} {}\n", type, type_group(basis, type), style);
    for (std::size_t k = 0; k < basis.types.grain_walls.size(); ++k) {
        const std::size_t type = basis.simulation.model.materials.list.size() + 1 + k;
        text += fmt::format("neigh_modify exclude type {} {}\n", type, type);
    }
    return text;
}

std::string deck_outputs(const DeckBasis& basis, ExportNotes& notes)
{
    const scene::Scene& scene = basis.scene;
    std::string text;
    const auto steps = [&](const char* name, double interval) {
        // never longer than the run, so that it is a whole number even where the scene says inf
        text +=
            fmt::format("variable {} equal ceil({:.10g}/${{step}})\n", name, std::min(interval, scene.time.duration));
    };
    steps("frame", scene.time.frame_interval);
    text += "dump frames all custom ${frame} frames.lammpstrj id type radius x y z vx vy vz omegax omegay omegaz\n"
            "dump_modify frames sort id\nthermo ${frame}\nthermo_modify lost ignore\n";
    for (std::size_t k = 0; k < scene.outlet.size(); ++k)
        if (const auto region = region_words(basis.simulation.model.outlets[k]))
            text += fmt::format("region {} {} units box\n", deck_id("outlet", k, scene.outlet[k].name), *region);
        else
            notes.push_back(fmt::format(
                "the outlet '{}' is left out: its region is none that the program knows", scene.outlet[k].name));
    for (std::size_t k = 0; k < scene.sensor.size(); ++k) {
        const scene::SensorTable& sensor = scene.sensor[k];
        if (sensor.kind != "mass_flow") {
            notes.push_back(fmt::format(
                "the sensor '{}' of kind {} is left out: measure it on the frames", sensor.name, sensor.kind));
            continue;
        }
        const std::string id = deck_id("flow", k, sensor.name);
        if (text.find("variable sample ") == std::string::npos) steps("sample", scene.time.metrics_interval);
        text += fmt::format("region {} plane {} {} units box\nvariable {} equal ", id, words(sensor.point),
            words(-sensor.normal.normalized()), id);
        for (const int type : basis.types.moving)
            text += fmt::format(
                "{}mass({},{})", type == basis.types.moving.front() ? "" : "+", type_group(basis, type), id);
        text += fmt::format("\nfix {} all print ${{sample}} \"${{t}} ${{{}}}\" file {}.txt screen no title \"time_s "
                            "mass_before_kg\"\n",
            id, id, id);
        notes.push_back(fmt::format(
            "the sensor '{}' is {}.txt, with the mass that is still before its plane: the flow is "
            "minus its slope, but for what is poured in{}",
            sensor.name, id, basis.simulation.model.periodicity.any() ? " or comes round along a periodic axis" : ""));
    }
    return text;
}

std::vector<std::string> outlet_regions(const DeckBasis& basis)
{
    std::vector<std::string> regions;
    for (std::size_t k = 0; k < basis.scene.outlet.size(); ++k)
        if (region_words(basis.simulation.model.outlets[k]))
            regions.push_back(deck_id("outlet", k, basis.scene.outlet[k].name));
    return regions;
}

std::string deck_runs(const DeckBasis& basis, const Timeline& timeline, const std::string& every)
{
    const double duration = basis.simulation.duration;
    std::string text;
    for (auto moment = timeline.begin(); moment != timeline.end(); ++moment) {
        const double end = std::next(moment) == timeline.end() ? duration : std::next(moment)->first;
        if (moment->first > 0.0) text += fmt::format("\n# t = {:.6g} s\n", moment->first);
        text += moment->second;
        text += fmt::format("variable until equal ceil({:.10g}/${{step}})\nrun ${{until}} upto{}\n", end, every);
    }
    return text;
}

ExportNotes common_notes(const DeckBasis& basis)
{
    const Model& model = basis.simulation.model;
    ExportNotes notes;
    for (const scene::ContactTable& contact : basis.scene.contact)
        if (std::isfinite(contact.stiffness))
            notes.push_back(
                fmt::format("the stiffness {:.4g} N/m of the contact {} is left out: it is that of the modulus",
                    contact.stiffness, fmt::join(contact.between, "-")));
    if (const double greatest = greatest_modulus(model);
        std::isfinite(greatest) &&
        std::ranges::any_of(model.materials.laws, [&](const ContactLaw& law) { return law.modulus < greatest; }))
        notes.emplace_back("all contacts have the modulus of the stiffest two materials");
    for (const Wall& wall : model.walls)
        if (wall.is_piston())
            notes.push_back(fmt::format("the wall '{}' of finite mass stands still: forces do not move it", wall.name));
        else if (wall.moves() && std::holds_alternative<Grains>(wall.shape))
            notes.push_back(
                fmt::format("the wall '{}' stands still: grains of a wall do not move in the deck", wall.name));
        else if (std::holds_alternative<Grains>(wall.shape) && comes_or_goes(wall, basis.simulation.duration))
            notes.push_back(
                fmt::format("the wall '{}' is there all the time: grains of a wall neither come nor go in the "
                            "deck",
                    wall.name));
    for (int d = 0; d < 3; ++d)
        if (!model.periodicity.along(d) && !(std::isfinite(model.world.min[d]) && std::isfinite(model.world.max[d]))) {
            notes.push_back(
                fmt::format("the room ends at x {:.4g} to {:.4g}, y {:.4g} to {:.4g}, z {:.4g} to {:.4g} m, and "
                            "what leaves it is gone",
                    basis.box.min.x(), basis.box.max.x(), basis.box.min.y(), basis.box.max.y(), basis.box.min.z(),
                    basis.box.max.z()));
            break;
        }
    return notes;
}

} // namespace talus
