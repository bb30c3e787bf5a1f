// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/lammps_deck.hpp"

#include "io/export/mesh_parts.hpp"
#include "io/text/input_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

/// The surface energy γ with which LAMMPS' dmt pulls as this does, with 4πγR* [J/m²].
double surface_energy(const Model& model, int a, int b)
{
    if (!model.physics.attraction) return 0.0;
    const Attraction& law = model.materials.attraction(a, b);
    if (law.force > 0.0 || law.by_weight > 0.0 || law.volume > 0.0)
        throw InputError(
            "the scene has cohesion of a law other than dmt and jkr, which LAMMPS does not have, so there is "
            "no deck of it");
    return law.by_radius / (4.0 * std::acos(-1.0));
}

/// A contact of two materials in the words of `pair_style granular` and `wall/gran`.
std::string contact_words(const Model& model, int a, int b)
{
    const ContactLaw& law = model.materials.between(a, b);
    const double energy = surface_energy(model, a, b);
    const std::string normal = energy > 0.0
                                   ? fmt::format("dmt ${{modulus}} {} {} {:.10g}", law.restitution, poisson, energy)
                                   : fmt::format("hertz/material ${{modulus}} {} {}", law.restitution, poisson);
    std::string text = fmt::format("{} tangential mindlin NULL 1.0 {} damping tsuji", normal, law.friction);
    if (model.physics.rolling)
        text += fmt::format(" rolling sds ${{rolling_stiffness}} ${{rolling_damping}} {}", law.rolling_friction);
    return text;
}

/// Commands for the contacts between spheres, and the note on rolling resistance.
std::string pair_commands(const DeckBasis& basis, ExportNotes& notes)
{
    const Model& model = basis.simulation.model;
    const bool rolling = model.physics.rolling;
    std::string text;
    if (rolling) {
        const double mass =
            model.materials.list.front().density * std::acos(-1.0) / 6.0 * std::pow(model.mean_diameter, 3);
        // The spring is 0.4 times as stiff as the normal contact of two mean spheres at an overlap of 1 % of a
        // diameter.
        text += fmt::format("variable rolling_stiffness equal 0.04*{:.6g}*${{modulus}}/(2*(1-{}^2))\n"
                            "variable rolling_damping equal 0.6*sqrt(0.5*{:.6g}*v_rolling_stiffness)\n",
            model.mean_diameter, poisson, mass);
        notes.emplace_back(
            "rolling friction is LAMMPS' spring, dashpot and slider (rolling sds): the same largest torque, "
            "which it reaches only after some rolling");
    }
    if (model.physics.attraction)
        notes.emplace_back("adhesion is LAMMPS' dmt: the same force while two overlap, and none beyond");
    text += "pair_style granular\n";
    const int types = static_cast<int>(basis.types.material.size());
    for (int a = 1; a <= types; ++a)
        for (int b = a; b <= types; ++b)
            text += fmt::format("pair_coeff {} {} {}\n", a, b,
                contact_words(model, basis.types.material[static_cast<std::size_t>(a - 1)],
                    basis.types.material[static_cast<std::size_t>(b - 1)]));
    return text;
}

/// A conical surface round a coordinate axis, open at both ends.
std::optional<std::string> cone_words(
    const Vec3& base, const Vec3& axis, double height, double base_radius, double top_radius)
{
    const auto placed = along_axis(base, axis);
    if (!placed) return std::nullopt;
    double low = base[placed->axis], high = low + height * axis[placed->axis];
    if (low > high) {
        std::swap(low, high);
        std::swap(base_radius, top_radius);
    }
    if (base_radius == top_radius)
        return fmt::format("cylinder {} {:.10g} {:.10g} {:.10g} open 1 open 2", placed->words, base_radius, low, high);
    return fmt::format(
        "cone {} {:.10g} {:.10g} {:.10g} {:.10g} open 1 open 2", placed->words, base_radius, top_radius, low, high);
}

/// A plate as a flat parallelepiped, of which LAMMPS wants the first edge along x and the second across z.
std::optional<std::string> plate_words(const Plate& plate, double thickness)
{
    Vec3 corner = plate.corner, level = plate.edge_a, other = plate.edge_b;
    const double small = 1e-6 * std::max(level.norm(), other.norm());
    const auto is_zero = [&](double length) { return std::abs(length) < small; };
    const bool is_level = is_zero(level.z()) && is_zero(other.z());
    if (is_level ? !is_zero(level.y()) : !is_zero(level.z())) std::swap(level, other);
    if (is_level ? !is_zero(level.y()) : !is_zero(level.z())) return std::nullopt;
    const auto forward = [&](Vec3& edge, int d) { // begins at the other end where it goes back
        if (edge[d] > 0.0) return;
        corner += edge;
        edge = -edge;
    };
    const bool is_along_x = is_zero(level.y());
    forward(level, is_along_x ? 0 : 1);
    forward(other, is_level ? 1 : 2);
    const int across = is_level ? 2 : is_along_x ? 1 : 0;
    const Vec3 thin = thickness / std::abs(level.cross(other).normalized()[across]) * Vec3::Unit(across);
    const std::array<Vec3, 3> edges = is_level     ? std::array{level, other, thin}
                                      : is_along_x ? std::array{level, thin, other}
                                                   : std::array{thin, level, other};
    const Vec3 low = corner - 0.5 * thin;
    return fmt::format("prism {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} side out",
        low.x(), low.x() + edges[0].x(), low.y(), low.y() + edges[1].y(), low.z(), low.z() + edges[2].z(), edges[1].x(),
        edges[2].x(), edges[2].y());
}

/// A wall as the regions whose surface it is; none where there are no such. An open region is a thin wall with two
/// sides, and with rims.
struct RegionsOf {
    const DeckBasis& basis;
    const scene::WallTable& table;
    ExportNotes& notes;

    using Words = std::vector<std::string>;

    Words operator()(const Plane& plane) const
    {
        const Vec3 &p = plane.point, &n = plane.normal;
        return {fmt::format(
            "plane {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g}", p.x(), p.y(), p.z(), n.x(), n.y(), n.z())};
    }
    Words operator()(const Cylinder& tube) const
    {
        return one(cone_words(tube.base, tube.axis, tube.height, tube.radius, tube.radius));
    }
    Words operator()(const Cone& funnel) const
    {
        return one(cone_words(funnel.base, funnel.axis, funnel.height, funnel.base_radius, funnel.top_radius));
    }
    /// A plate is the outside of a cylinder that is nearly flat. A ring is no region, but a cone that is nearly flat is
    /// one; near its axis LAMMPS would take it for a sharp tip.
    Words operator()(const Disk& plate) const
    {
        const double height = thickness();
        const Vec3 base = plate.center - 0.5 * height * plate.normal;
        if (plate.hole_radius > 0.0)
            return one(cone_words(base, plate.normal, height, plate.hole_radius, plate.radius));
        Region slice;
        slice.shape = Region::Shape::cylinder;
        slice.base = base;
        slice.axis = plate.normal;
        slice.radius = plate.radius;
        slice.height = height;
        const auto words = region_words(slice);
        return words ? Words{*words + " side out"} : Words{};
    }
    Words operator()(const Panels&) const
    {
        std::string text = box_words({table.min, table.max});
        for (const std::string& face : table.open)
            text += fmt::format(" open {}", 2 * (face[0] - 'x') + (face[1] == '+' ? 2 : 1));
        return {text};
    }
    Words operator()(const Mesh& mesh) const
    {
        Words list;
        const RoundParts round = round_parts(mesh);
        for (const Shape& part : round.shapes) {
            const Words words = std::visit(*this, part);
            list.insert(list.end(), words.begin(), words.end());
        }
        if (!list.empty()) {
            notes.push_back(fmt::format("the mesh '{}' is round: the circles through its corners, which lie up to "
                                        "{:.2g} mm outside its triangles",
                table.name, 1e3 * round.sag));
            return list;
        }
        for (const Plate& plate : plates(mesh)) {
            const auto words = plate_words(plate, thickness());
            if (!words) return {};
            list.push_back(*words);
        }
        return list;
    }
    Words operator()(const Grains&) const { return {}; }

private:
    /// Of what is flat.
    double thickness() const { return 1e-3 * basis.simulation.model.mean_diameter; }
    static Words one(const std::optional<std::string>& words) { return words ? Words{*words} : Words{}; }
};

/// How long a part of a motion has gone on, as a formula of `t`.
std::string elapsed(const MotionSpan& span)
{
    std::string text = fmt::format("(v_t>{0:.10g})*(v_t-{0:.10g})", span.from);
    if (std::isfinite(span.to)) text += fmt::format("-(v_t>{0:.10g})*(v_t-{0:.10g})", span.to);
    return fmt::format("({})", text);
}

/// A wall's motion as formulas: how far it is shifted along each axis, and by which angle it is turned before that.
struct MotionFormulas {
    std::array<std::string, 3> shift;
    const Turning* turning = nullptr;
    bool possible = true; ///< LAMMPS turns once, and then shifts

    explicit MotionFormulas(const WallMotion& motion)
    {
        for (const MotionPart& part : motion) std::visit(*this, part);
    }

    void operator()(const Translation& part) { add(part.velocity, elapsed(part.span)); }
    void operator()(const Shaking& part)
    {
        add(part.amplitude, fmt::format("sin(2*PI*{:.10g}*{})", part.frequency, elapsed(part.span)));
    }
    void operator()(const Turning& part)
    {
        possible = possible && !turning && shift[0].empty() && shift[1].empty() && shift[2].empty();
        turning = &part;
    }
    void operator()(const Course& part)
    {
        add(part.waypoints.front().shift, "1");
        for (std::size_t k = 0; k + 1 < part.waypoints.size(); ++k) {
            const auto &one = part.waypoints[k], &next = part.waypoints[k + 1];
            add((next.shift - one.shift) / (next.time - one.time), elapsed({one.time, next.time}));
        }
    }

private:
    void add(const Vec3& factor, const std::string& formula)
    {
        for (int d = 0; d < 3; ++d)
            if (factor[d] != 0.0)
                shift[static_cast<std::size_t>(d)] += fmt::format(
                    "{}{:.10g}*{}", shift[static_cast<std::size_t>(d)].empty() ? "" : "+", factor[d], formula);
    }
};

/// The end of a region's command for a wall that moves; its variables go to `variables`.
std::string motion_words(const Wall& wall, const std::string& id, std::string& variables, ExportNotes& notes)
{
    if (wall.motion.empty()) return "";
    const MotionFormulas formulas(wall.motion);
    if (!formulas.possible) {
        notes.push_back(
            fmt::format("the wall '{}' stands still: LAMMPS turns a wall once, and shifts it after that", wall.name));
        return "";
    }
    std::string text;
    if (std::ranges::any_of(formulas.shift, [](const std::string& formula) { return !formula.empty(); })) {
        text += " move";
        for (std::size_t d = 0; d < 3; ++d) {
            const std::string variable = fmt::format("{}_{}", id, "xyz"[d]);
            if (!formulas.shift[d].empty())
                variables += fmt::format("variable {} equal {}\n", variable, formulas.shift[d]);
            text += formulas.shift[d].empty() ? " NULL" : fmt::format(" v_{}", variable);
        }
    }
    if (const Turning* turning = formulas.turning) {
        variables += fmt::format("variable {}_angle equal {:.10g}*{}\n", id, turning->rate, elapsed(turning->span));
        const Vec3 &p = turning->point, &a = turning->axis;
        text += fmt::format(" rotate v_{}_angle {:.10g} {:.10g} {:.10g} {:.10g} {:.10g} {:.10g}", id, p.x(), p.y(),
            p.z(), a.x(), a.y(), a.z());
    }
    return text;
}

void add_walls(const DeckBasis& basis, Deck& deck, Timeline& timeline)
{
    const Model& model = basis.simulation.model;
    for (std::size_t k = 0; k < model.walls.size(); ++k) {
        const Wall& wall = model.walls[k];
        if (std::holds_alternative<Grains>(wall.shape)) continue; // they are in the data file
        const std::string id = deck_id("wall", k, wall.name);
        const auto regions = std::visit(RegionsOf{basis, basis.scene.wall[k], deck.notes}, wall.shape);
        if (regions.empty()) {
            deck.notes.push_back(
                std::holds_alternative<Mesh>(wall.shape)
                    ? fmt::format("the wall '{}' is left out: LAMMPS has no walls of triangles, and it is neither "
                                  "round an axis x, y or z nor of rectangles with a level edge",
                          wall.name)
                    : fmt::format(
                          "the wall '{}' is left out: LAMMPS has round walls along x, y and z only", wall.name));
            continue;
        }
        const bool closed = regions.front().starts_with("block") && regions.front().find("open") == std::string::npos;
        if (closed) deck.notes.push_back(fmt::format("the box '{}' is felt from inside only", wall.name));
        const std::string motion = motion_words(wall, id, deck.text, deck.notes);
        for (std::size_t r = 0; r < regions.size(); ++r) {
            const std::string part = regions.size() > 1 ? fmt::format("{}_part{}", id, r) : id;
            deck.text += fmt::format("region {} {}{} units box\n", part, regions[r], motion);
            for (const int type : basis.types.moving) {
                const std::string fix = fmt::format("{}_{}", part, type);
                timeline[wall.appear_at] += fmt::format("fix {} {} wall/gran/region granular {} region {}\n", fix,
                    type_group(basis, type), contact_words(model, type - 1, wall.material), part);
                if (wall.remove_at < basis.simulation.duration)
                    timeline[wall.remove_at] += fmt::format("unfix {}\n", fix);
            }
        }
    }
}

/// The time that `fix pour` leaves between two bursts: a sphere falls through the region [s].
double fall_time(double height, double speed, double gravity)
{
    return (std::sqrt(speed * speed + 2.0 * gravity * height) - speed) / gravity;
}

/// Whether `fix pour` can do a pour, and if not, why.
std::string objection(const Pour& pour, const Vec3& gravity)
{
    if (!(gravity.z() < 0.0 && gravity.head<2>().norm() == 0.0))
        return "LAMMPS pours along -z only, and gravity is elsewhere";
    const bool upright = pour.region.shape == Region::Shape::cylinder && std::abs(pour.region.axis.z()) > 1.0 - 1e-12;
    if (!upright && pour.region.shape != Region::Shape::box)
        return "LAMMPS pours into boxes and upright cylinders only";
    if (pour.velocity.z() > 0.0) return "LAMMPS pours downwards only";
    return "";
}

void add_pour(const DeckBasis& basis, std::size_t index, Deck& deck, Timeline& timeline)
{
    constexpr double densest = 0.3; // what fits into the region at random, at once
    const Pour& pour = basis.simulation.pours[index];
    const Model& model = basis.simulation.model;
    const std::string why_not = objection(pour, model.gravity);
    if (!why_not.empty()) {
        deck.notes.push_back(fmt::format("the pour '{}' is left out: {}", pour.name, why_not));
        return;
    }
    const std::string region = deck_id("pour", index, pour.name);
    deck.text += fmt::format("region {} {} units box\n", region, *region_words(pour.region));
    const double rate = std::min(pour.rate, pour.mass_rate / pour.mixture.mean_mass(model.materials));
    const double burst = fall_time(pour.region.bounds().extent().z(), -pour.velocity.z(), model.gravity.norm());
    for (std::size_t s = 0; s < pour.mixture.species.size(); ++s) {
        const Species& species = pour.mixture.species[s];
        const Mixture alone{{Species{species.material, species.diameter, 1.0}}};
        const double volume = alone.mean_volume(), room = pour.region.volume();
        const double at_once =
            std::clamp(rate * species.number * burst, 1.0, std::max(1.0, std::floor(densest * room / volume)));
        if (std::abs(at_once / burst - rate * species.number) > 0.05 * rate * species.number)
            deck.notes.push_back(
                fmt::format("the pour '{}' comes in at {:.3g} spheres a second of {}, not at {:.3g}: LAMMPS "
                            "lets a burst in whenever the last has fallen through the region",
                    pour.name, at_once / burst, model.materials.list[static_cast<std::size_t>(species.material)].name,
                    rate * species.number));
        std::vector<std::string> sizes;
        for (const SizeClass& size : size_classes(alone))
            sizes.push_back(fmt::format("{:.10g} {}", size.diameter, size.share));
        const double density = model.materials.list[static_cast<std::size_t>(species.material)].density;
        const double count = expected_count(pour, model.materials) * species.number;
        // half a sphere more than wanted, as LAMMPS rounds down
        timeline[pour.start] +=
            fmt::format("fix {}_{} {} pour {:.0f} {} {} region {} diam poly {} {} dens {} {} vol {:.6g} 100 "
                        "vel {} {} {} {} {}\n",
                region, s, type_group(basis, species.material + 1), count, species.material + 1, 4711 + 10 * index + s,
                region, sizes.size(), fmt::join(sizes, " "), density, density, (at_once + 0.5) * volume / room,
                pour.velocity.x(), pour.velocity.x(), pour.velocity.y(), pour.velocity.y(), pour.velocity.z());
    }
    deck.notes.push_back(fmt::format(
        "the pour '{}' comes in bursts of spheres at random places, of up to eight sizes a kind", pour.name));
}

} // namespace

Deck lammps_deck(const DeckBasis& basis)
{
    const Model& model = basis.simulation.model;
    Deck deck;
    deck.notes = common_notes(basis);
    std::string boundary;
    for (int d = 0; d < 3; ++d) boundary += model.periodicity.along(d) ? " p" : " f";
    deck.text = fmt::format("\nunits si\natom_style sphere\nboundary{}\nnewton off\ncomm_modify vel yes\n", boundary);
    deck.text += deck_room(basis) + "\n" + pair_commands(basis, deck.notes) + "\n" + deck_motion(basis) + "\n";
    Timeline timeline;
    timeline[0.0];
    add_walls(basis, deck, timeline);
    for (std::size_t k = 0; k < basis.simulation.pours.size(); ++k) add_pour(basis, k, deck, timeline);
    deck.text += "\n" + deck_outputs(basis, deck.notes);
    for (const std::string& region : outlet_regions(basis))
        deck.text +=
            fmt::format("variable look equal ceil({}/${{step}})\nfix {} all evaporate ${{look}} 100000000 {} 4711\n",
                outlet_interval, region, region);
    timeline.erase(timeline.lower_bound(basis.simulation.duration), timeline.end());
    deck.text += "\n" + deck_runs(basis, timeline);
    return deck;
}

} // namespace talus
