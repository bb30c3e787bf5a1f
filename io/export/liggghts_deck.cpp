// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/liggghts_deck.hpp"

#include "core/world/placed_wall.hpp"
#include "io/export/stl_text.hpp"
#include "io/run/wall_surface.hpp"
#include "io/text/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace talus
{
namespace
{

constexpr double least_restitution = 0.051; ///< LIGGGHTS takes none up to 0.05

/// The next prime number: LIGGGHTS takes no other seeds.
class Seeds
{
public:
    int next()
    {
        do ++last_;
        while (!is_prime(last_));
        return last_;
    }

private:
    int last_ = 100000;

    static bool is_prime(int number)
    {
        for (int divisor = 2; divisor * divisor <= number; ++divisor)
            if (number % divisor == 0) return false;
        return true;
    }
};

/// Properties of materials and of their pairs, in the one form that LIGGGHTS reads.
std::string properties(const DeckBasis& basis)
{
    const Model& model = basis.simulation.model;
    const auto& materials = basis.types.material;
    std::string moduli, ratios, text;
    for (std::size_t k = 0; k < materials.size(); ++k) {
        moduli += " ${modulus}";
        ratios += fmt::format(" {}", poisson);
    }
    text += fmt::format("fix modulus all property/global youngsModulus peratomtype{}\n"
                        "fix poisson all property/global poissonsRatio peratomtype{}\n",
        moduli, ratios);
    const auto add_pairs = [&](const char* fix, const char* name,
                               const std::function<double(const ContactLaw&)>& value) {
        text += fmt::format("fix {} all property/global {} peratomtypepair {}", fix, name, materials.size());
        for (const int a : materials)
            for (const int b : materials) text += fmt::format(" {}", value(model.materials.between(a, b)));
        text += "\n";
    };
    add_pairs("rebound", "coefficientRestitution",
        [](const ContactLaw& law) { return std::max(law.restitution, least_restitution); });
    add_pairs("rubbing", "coefficientFriction", [](const ContactLaw& law) { return law.friction; });
    if (model.physics.rolling)
        add_pairs("rolling", "coefficientRollingFriction", [](const ContactLaw& law) { return law.rolling_friction; });
    return text;
}

/// The words for the model of contacts.
std::string model_words(const Model& model)
{
    return fmt::format("gran model hertz tangential history{}", model.physics.rolling ? " rolling_friction epsd2" : "");
}

void refuse_cohesion(const Model& model)
{
    if (model.physics.attraction)
        throw InputError("the scene has cohesion; LIGGGHTS has none whose force is a given one (its sjkr goes with the "
                         "area of the overlap), so there is no deck of it");
}

void note_contacts(const DeckBasis& basis, ExportNotes& notes)
{
    const Model& model = basis.simulation.model;
    if (std::ranges::any_of(basis.scene.contact,
            [](const scene::ContactTable& contact) { return contact.restitution < least_restitution; }))
        notes.push_back(
            fmt::format("restitutions below {0} are {0}: LIGGGHTS takes none up to 0.05", least_restitution));
    if (model.physics.rolling)
        notes.emplace_back("rolling friction is LIGGGHTS' spring and slider (epsd2): the same largest torque, which it "
                           "reaches only after some rolling");
}

/// A part of a motion as `fix move/mesh` calls it: when it begins and ends, and its words.
struct MovePart {
    MotionSpan span;
    std::string words;
};

struct MoveParts {
    std::vector<MovePart> list;

    static std::string words(const Vec3& v) { return fmt::format("{:.10g} {:.10g} {:.10g}", v.x(), v.y(), v.z()); }

    void operator()(const Translation& part) { list.push_back({part.span, "linear " + words(part.velocity)}); }
    void operator()(const Shaking& part)
    {
        list.push_back({part.span,
            fmt::format("wiggle amplitude {} period {:.10g}", words(part.amplitude), 1.0 / part.frequency)});
    }
    void operator()(const Turning& part)
    {
        if (part.rate == 0.0) return;
        const double sign = part.rate > 0.0 ? 1.0 : -1.0;
        list.push_back({part.span, fmt::format("rotate origin {} axis {} period {:.10g}", words(part.point),
                                       words(sign * part.axis), 2.0 * std::acos(-1.0) / std::abs(part.rate))});
    }
    void operator()(const Course& part)
    {
        for (std::size_t k = 0; k + 1 < part.waypoints.size(); ++k) {
            const auto &one = part.waypoints[k], &next = part.waypoints[k + 1];
            list.push_back(
                {{one.time, next.time}, "linear " + words((next.shift - one.shift) / (next.time - one.time))});
        }
    }
};

/// The part of a polygon on the side of a plane to which its normal points.
std::vector<Vec3> cut(const std::vector<Vec3>& polygon, const Vec3& point, const Vec3& normal)
{
    std::vector<Vec3> inside;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 &one = polygon[k], &next = polygon[(k + 1) % polygon.size()];
        const double a = (one - point).dot(normal), b = (next - point).dot(normal);
        if (a >= 0.0) inside.push_back(one);
        if ((a >= 0.0) != (b >= 0.0)) inside.push_back(one + a / (a - b) * (next - one));
    }
    return inside;
}

/// The part of a plane that lies in a box: LIGGGHTS loses triangles whose middle does not.
TriangleSoup part_in(const Box& box, const Plane& plane)
{
    const Vec3 center = box.center() - (box.center() - plane.point).dot(plane.normal) * plane.normal;
    const Vec3 u = box.extent().norm() * any_perpendicular(plane.normal), v = plane.normal.cross(u);
    std::vector<Vec3> polygon = {center - u - v, center + u - v, center + u + v, center - u + v};
    for (int d = 0; d < 3; ++d) {
        polygon = cut(polygon, box.min, Vec3::Unit(d));
        polygon = cut(polygon, box.max, -Vec3::Unit(d));
    }
    TriangleSoup soup{polygon, {}};
    for (std::int32_t k = 2; k < static_cast<std::int32_t>(polygon.size()); ++k)
        soup.triangles.push_back({0, k - 1, k});
    return soup;
}

/// "zplane 0.1" for a plane that stands still across an axis, which LIGGGHTS has without triangles.
std::optional<std::string> primitive_words(const Wall& wall)
{
    const auto* plane = std::get_if<Plane>(&wall.shape);
    if (!plane || wall.moves()) return std::nullopt;
    const auto placed = along_axis(plane->point, plane->normal);
    if (!placed) return std::nullopt;
    return fmt::format("{}plane {:.10g}", "xyz"[placed->axis], plane -> point[placed->axis]);
}

/// The surface of a wall as it stands when it comes.
TriangleSoup surface_of(const Wall& wall, const DeckBasis& basis)
{
    const auto* plane = std::get_if<Plane>(&wall.shape);
    TriangleSoup soup = plane ? part_in(basis.box, *plane) : wall_surface(wall.shape, basis.simulation.model.contents);
    const Pose pose = pose_at(wall.motion, wall.appear_at);
    for (Vec3& vertex : soup.vertices) vertex = pose(vertex);
    return soup;
}

/// What is done at a moment, in the order in which LIGGGHTS can do it.
struct Moment {
    std::string end_contacts, end_motions, end_walls, begin_walls, begin_contacts, begin_rest;

    std::string text() const
    {
        return end_contacts + end_motions + end_walls + begin_walls + begin_contacts + begin_rest;
    }
};
using Moments = std::map<double, Moment>;

void add_motion(const Wall& wall, const std::string& id, double gone, Moments& moments, ExportNotes& notes)
{
    MoveParts parts;
    for (const MotionPart& part : wall.motion) std::visit(std::ref(parts), part);
    for (std::size_t k = 0; k < parts.list.size(); ++k) {
        const auto& [span, words] = parts.list[k];
        const double from = std::max(span.from, wall.appear_at), to = std::min(span.to, gone);
        if (from >= to) continue;
        moments[from].begin_rest += fmt::format("fix {}_move{} all move/mesh mesh {} {}\n", id, k, id, words);
        // in the opposite order
        moments[to].end_motions = fmt::format("unfix {}_move{}\n", id, k) + moments[to].end_motions;
        if (words.starts_with("wiggle") && from > span.from)
            notes.push_back(fmt::format("the wall '{}' begins to shake when it appears, not before", wall.name));
    }
    if (wall.motion.size() > 1)
        notes.push_back(
            fmt::format("the parts of the motion of '{}' are laid over each other as LIGGGHTS does it", wall.name));
}

/// Whether a wall comes to LIGGGHTS as triangles.
bool is_mesh(const Wall& wall)
{
    return !std::holds_alternative<Grains>(wall.shape) && !primitive_words(wall);
}

/// One fix for the contacts of all walls of triangles that stand, which is all that LIGGGHTS has; anew whenever one
/// comes or goes.
void add_contacts_of_walls(const DeckBasis& basis, Moments& moments, ExportNotes& notes)
{
    const Model& model = basis.simulation.model;
    bool there = false;
    for (auto& [time, moment] : moments) {
        if (time >= basis.simulation.duration || (moment.begin_walls.empty() && moment.end_walls.empty())) continue;
        if (there) moment.end_contacts += "unfix contacts\n";
        if (there)
            notes.push_back(fmt::format("at {:.4g} s friction at the walls begins anew: LIGGGHTS has one fix for all "
                                        "that are made of triangles",
                time));
        std::string meshes;
        int count = 0;
        for (std::size_t k = 0; k < model.walls.size(); ++k)
            if (model.walls[k].stands_at(time) && is_mesh(model.walls[k])) {
                meshes += " " + deck_id("wall", k, model.walls[k].name);
                ++count;
            }
        there = count > 0;
        if (there)
            moment.begin_contacts =
                fmt::format("fix contacts all wall/{} mesh n_meshes {} meshes{}\n", model_words(model), count, meshes);
    }
}

void add_walls(const DeckBasis& basis, Deck& deck, Moments& moments)
{
    const Model& model = basis.simulation.model;
    const double duration = basis.simulation.duration;
    bool round = false;
    for (std::size_t k = 0; k < model.walls.size(); ++k) {
        const Wall& wall = model.walls[k];
        if (std::holds_alternative<Grains>(wall.shape)) continue; // they are in the data file
        const std::string id = deck_id("wall", k, wall.name), stl = id + ".stl";
        if (const auto words = primitive_words(wall)) {
            moments[wall.appear_at].begin_rest += fmt::format(
                "fix {} all wall/{} primitive type {} {}\n", id, model_words(model), wall.material + 1, *words);
            if (wall.remove_at < duration) moments[wall.remove_at].end_contacts += fmt::format("unfix {}\n", id);
            continue;
        }
        deck.files.emplace(stl, stl_text(surface_of(wall, basis)));
        round = round || std::holds_alternative<Cylinder>(wall.shape) || std::holds_alternative<Cone>(wall.shape) ||
                std::holds_alternative<Disk>(wall.shape);
        moments[wall.appear_at].begin_walls +=
            fmt::format("fix {} all mesh/surface file {} type {}\n", id, stl, wall.material + 1);
        add_motion(wall, id, std::min(wall.remove_at, duration), moments, deck.notes);
        if (wall.remove_at < duration) moments[wall.remove_at].end_walls += fmt::format("unfix {}\n", id);
    }
    add_contacts_of_walls(basis, moments, deck.notes);
    if (round) deck.notes.emplace_back("round walls have 64 flat sides");
}

void add_pour(const DeckBasis& basis, std::size_t index, Seeds& seeds, Deck& deck, Moments& moments)
{
    const Pour& pour = basis.simulation.pours[index];
    const Materials& materials = basis.simulation.model.materials;
    const std::string id = deck_id("pour", index, pour.name);
    const auto region = region_words(pour.region);
    if (!region) {
        deck.notes.push_back(
            fmt::format("the pour '{}' is left out: its region is none that LIGGGHTS knows", pour.name));
        return;
    }
    std::string& text = deck.text;
    text += fmt::format("region {} {} units box\n", id, *region);
    const std::vector<SizeClass> sizes = size_classes(pour.mixture);
    std::string shares;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const SizeClass& size = sizes[k];
        text += fmt::format(
            "fix {}_size{} {} particletemplate/sphere {} atom_type {} density constant {} radius constant {:.10g}\n",
            id, k, type_group(basis, size.material + 1), seeds.next(), size.material + 1,
            materials.list[static_cast<std::size_t>(size.material)].density, 0.5 * size.diameter);
        shares += fmt::format(" {}_size{} {:.10g}", id, k, size.share);
    }
    text += fmt::format(
        "fix {}_sizes all particledistribution/discrete/numberbased {} {}{}\n", id, seeds.next(), sizes.size(), shares);
    // some spheres at a time, or they would hardly be a mixture; but not so many that they find no room
    constexpr double at_once = 5.0;
    const double rate = std::min(pour.rate, pour.mass_rate / pour.mixture.mean_mass(materials));
    text += fmt::format("variable {}_every equal ceil({:.6g}/${{step}})\n", id, at_once / rate);
    moments[pour.start].begin_rest +=
        fmt::format("fix {0} all insert/rate/region seed {1} distributiontemplate {0}_sizes nparticles {2:.0f} "
                    "particlerate {3:.10g} "
                    "insert_every ${{{0}_every}} overlapcheck yes all_in yes vel constant {4} {5} {6} region {0}\n",
            id, seeds.next(), expected_count(pour, materials), rate, pour.velocity.x(), pour.velocity.y(),
            pour.velocity.z());
    deck.notes.push_back(fmt::format(
        "the pour '{}' lets other spheres in at other places, of up to eight sizes a kind, {:.0f} at a time", pour.name,
        at_once));
}

} // namespace

Deck liggghts_deck(const DeckBasis& basis)
{
    refuse_cohesion(basis.simulation.model);
    const Model& model = basis.simulation.model;
    Deck deck;
    deck.notes = common_notes(basis);
    note_contacts(basis, deck.notes);
    std::string boundary;
    for (int d = 0; d < 3; ++d) boundary += model.periodicity.along(d) ? " p" : " f";
    deck.text =
        fmt::format("\natom_style granular\natom_modify map array\nboundary{}\nnewton off\ncommunicate single vel yes\n"
                    "units si\n",
            boundary);
    deck.text += deck_room(basis) + "\n" + properties(basis);
    deck.text += fmt::format("pair_style {}\npair_coeff * *\n\n", model_words(model));
    deck.text += deck_motion(basis) + "\n";
    Moments moments;
    moments[0.0];
    add_walls(basis, deck, moments);
    Seeds seeds;
    for (std::size_t k = 0; k < basis.simulation.pours.size(); ++k) add_pour(basis, k, seeds, deck, moments);
    deck.text += "\n" + deck_outputs(basis, deck.notes);
    Timeline timeline;
    for (const auto& [time, moment] : moments)
        if (time < basis.simulation.duration) timeline.emplace(time, moment.text());
    std::string every;
    for (const std::string& region : outlet_regions(basis))
        every += fmt::format(" \"delete_atoms region {} compress no\"", region);
    if (!every.empty()) {
        deck.text += fmt::format("variable look equal ceil({}/${{step}})\n", outlet_interval);
        every = " every ${look}" + every;
    }
    deck.text += "\n" + deck_runs(basis, timeline, every);
    return deck;
}

} // namespace talus
