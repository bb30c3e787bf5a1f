// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/summary.hpp"

#include "io/run/run_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

using Json = nlohmann::ordered_json; // it writes numbers that are not finite as null

const char* kind_name(Incident::Kind kind)
{
    switch (kind) {
    case Incident::Kind::escaped:
        return "escaped";
    case Incident::Kind::not_a_number:
        return "not_a_number";
    case Incident::Kind::blow_up:
        return "blow_up";
    case Incident::Kind::pressed:
        return "pressed";
    case Incident::Kind::appeared_inside:
        return "appeared_inside";
    }
    return "";
}

const char* sentence_of(Incident::Kind kind)
{
    switch (kind) {
    case Incident::Kind::escaped:
        return "left the world where there is no outlet";
    case Incident::Kind::not_a_number:
        return "has a position or velocity that is not a number";
    case Incident::Kind::blow_up:
        return "moves faster than anything in this scene can";
    case Incident::Kind::pressed:
        return "is pressed so that no motion obeys its contacts";
    case Incident::Kind::appeared_inside:
        return "is where a wall appears";
    }
    return "";
}

/// "'floor' and 'lid'", "0, 1, 2 and 7 more": as many as told, the others by their number.
std::string enumeration(const std::vector<std::string>& names)
{
    constexpr std::size_t told = 4;
    std::vector<std::string> parts(
        names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(told, names.size())));
    if (names.size() > told) parts.push_back(fmt::format("{} more", names.size() - told));
    if (parts.size() < 2) return parts.empty() ? "" : parts.front();
    const std::string last = parts.back();
    parts.pop_back();
    return fmt::format("{} and {}", fmt::join(parts, ", "), last);
}

std::string describe_press(const Incident& incident, const std::vector<std::string>& wall_names)
{
    std::vector<std::string> with, walls;
    for (const auto id : incident.spheres)
        if (id != incident.id) with.push_back(std::to_string(id));
    for (const auto wall : incident.walls)
        walls.push_back(fmt::format("'{}'", wall_names[static_cast<std::size_t>(wall)]));
    const auto& x = incident.position;
    return fmt::format("sphere {} {}: it overlaps by {:.2g} m at ({:.4g}, {:.4g}, {:.4g}) m, and more with every step, "
                       "{}between {}",
        incident.id, sentence_of(incident.kind), incident.overlap, x.x(), x.y(), x.z(),
        with.empty() ? "" : fmt::format("with {} {} ", with.size() == 1 ? "sphere" : "spheres", enumeration(with)),
        walls.empty() ? "spheres"
                      : fmt::format("{} {}", walls.size() == 1 ? "the wall" : "the walls", enumeration(walls)));
}

std::string describe_wall_inside(const Incident& incident, const std::vector<std::string>& wall_names)
{
    const auto& x = incident.position;
    return fmt::format(
        "the wall '{}' appears inside {} {}: it overlaps sphere {} at ({:.4g}, {:.4g}, {:.4g}) m by {:.2g} m",
        wall_names[static_cast<std::size_t>(incident.walls.front())], incident.spheres.size(),
        incident.spheres.size() == 1 ? "sphere" : "spheres", incident.id, x.x(), x.y(), x.z(), incident.overlap);
}

Json to_json(const Incident& incident, const std::vector<std::string>& wall_names)
{
    const auto& x = incident.position;
    Json json = {{"kind", kind_name(incident.kind)}, {"id", incident.id}, {"position", {x.x(), x.y(), x.z()}},
        {"speed", incident.speed}, {"last_wall", nullptr}, {"sentence", describe(incident, wall_names)}};
    if (incident.last_wall >= 0) json["last_wall"] = wall_names[static_cast<std::size_t>(incident.last_wall)];
    if (incident.walls.empty()) return json;
    json["spheres"] = incident.spheres;
    json["walls"] = Json::array();
    for (const auto wall : incident.walls) json["walls"].push_back(wall_names[static_cast<std::size_t>(wall)]);
    return json;
}

Json to_json(const std::vector<Incident>& incidents, const std::vector<std::string>& wall_names)
{
    Json json = Json::array();
    for (const Incident& incident : incidents) json.push_back(to_json(incident, wall_names));
    return json;
}

/// A title may hold bytes that are not UTF-8 text; they must not cost the summary of a finished run.
std::string text_of(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json to_json(const ParticleLedger& ledger)
{
    return {{"inserted", ledger.inserted}, {"inside", ledger.inside}, {"left", ledger.left},
        {"escaped", ledger.escaped}, {"taken_out", ledger.taken_out}, {"closes", ledger.closes()}};
}

template <class Value> Json or_null(const std::optional<Value>& value)
{
    return value ? Json(*value) : Json();
}

Json to_json(const std::vector<PourSummary>& pours)
{
    Json json = Json::array();
    for (const PourSummary& pour : pours)
        json.push_back({{"name", pour.name}, {"asked", or_null(pour.asked)}, {"asked_mass", or_null(pour.asked_mass)},
            {"poured", pour.poured}, {"poured_mass", pour.poured_mass}, {"shortfall", pour.shortfall}});
    return json;
}

Json to_json(const std::vector<Explanation>& explanations)
{
    Json json = Json::object();
    for (const Explanation& one : explanations) json[one.about] = one.sentence;
    return json;
}

/// @param window over which it is averaged [s]
Json to_json(const Measurement& m, double window)
{
    Json json = {{"value", m.value}, {"spread", m.spread}, {"unit", m.unit}};
    if (!m.independent || !std::isfinite(m.value)) return json;
    json["independent_samples"] = *m.independent;
    json["correlation_time"] = window / *m.independent;
    if (m.too_few) json["caution"] = too_few_samples;
    return json;
}

Json to_json(const ChangeOfResult& change)
{
    return {{"change", change.mean}, {"noise", change.noise}, {"pieces", change.pieces}, {"seen", change.is_seen()},
        {"error", change.error()}};
}

Json to_json(const std::vector<SensorSummary>& sensors)
{
    Json json = Json::object();
    for (const SensorSummary& sensor : sensors) {
        Json& quantities = json[sensor.name] = Json::object();
        for (const Measurement& m : sensor.results) quantities[m.name] = to_json(m, sensor.window);
        for (std::size_t k = 0; k < sensor.by_step.size(); ++k) {
            quantities[sensor.results[k].name]["step"] = to_json(sensor.by_step[k]);
            quantities[sensor.results[k].name]["solver"] = to_json(sensor.by_solver[k]);
        }
        for (const Measurement& m : sensor.results)
            if (!std::isfinite(m.value)) quantities[m.name]["silence"] = sensor.silence;
    }
    return json;
}

Json to_json(const MomentumSums& sums)
{
    return {{"from_gravity", sums.from_gravity}, {"from_walls", sums.from_walls}, {"left_over", sums.left_over}};
}

Json to_json(const SolverErrorSummary& solver)
{
    Json walls = Json::object();
    for (const WallForceError& wall : solver.walls) walls[wall.wall] = {{"error", wall.error}, {"force", wall.force}};
    return {{"looks", solver.looks}, {"made", solver.made}, {"share", solver.share}, {"to_the_end", solver.to_the_end},
        {"residual", solver.residual},
        {"velocity", {{"error", solver.velocity_error}, {"worst", solver.worst_velocity_error},
                         {"worst_at", solver.worst_time}, {"in_sqrt_gd", solver.in_fall_speeds},
                         {"of_flow", solver.of_flow}, {"of_contacts", solver.of_contacts}}},
        {"contact_forces", solver.force_error}, {"wall_forces", walls}};
}

Json to_json(const ErrorSummary& error, const std::vector<std::string>& wall_names)
{
    Json sub_steps = {{"steps", error.split_steps}, {"most", error.most_sub_steps}, {"asked_by", nullptr}};
    if (error.most_sub_steps > 1) sub_steps["asked_by"] = describe(error.split_for, wall_names);
    return {{"residual",
                {{"tolerance", error.tolerance}, {"mean", error.mean_residual}, {"percentile_95", error.residual_95},
                    {"worst", error.worst_residual}, {"steps_at_cap", error.steps_at_cap}}},

        {"overlap_d",
            {{"mean", error.mean_overlap}, {"worst", error.worst_overlap}, {"worst_at", error.worst_overlap_time}}},
        {"sub_steps", sub_steps}, {"cone_violation", error.cone_violation},
        {"pressure_scaling", {{"corrections", error.corrections}, {"refused", error.refused_corrections}}},
        {"energy", {{"lost", error.energy_lost}, {"gained", error.energy_gained}, {"put_in", error.energy_put_in}}},
        {"momentum", to_json(error.linear)}, {"angular_momentum", to_json(error.angular)}};
}

Json to_json(const TimingSummary& timing)
{
    Json phases = Json::object();
    for (const PhaseTime& phase : timing.phases) phases[phase.name] = {{"wall", phase.wall}, {"cpu", phase.cpu}};
    return {{"wall", timing.wall}, {"cpu", timing.cpu}, {"phases", phases}, {"contact_updates", timing.contact_updates},
        {"contact_updates_per_cpu_second", timing.contact_update_rate}};
}

} // namespace

bool ChangeOfResult::is_known() const
{
    constexpr std::int64_t least_pieces = 4;
    return pieces >= least_pieces;
}

bool ChangeOfResult::is_seen() const
{
    return is_known() && std::abs(mean) > 3.0 * noise;
}

double ChangeOfResult::error() const
{
    if (!is_known()) return std::numeric_limits<double>::quiet_NaN();
    return std::abs(mean) + (is_seen() ? 0.0 : 2.0 * noise);
}

std::string name_spheres(std::int64_t a, std::int64_t b)
{
    return fmt::format("spheres {} and {}", a, b);
}

std::string name_sphere_and_wall(std::int64_t sphere, const std::string& wall_name)
{
    return fmt::format("sphere {} and the wall '{}'", sphere, wall_name);
}

std::string describe(const Approach& approach, const std::vector<std::string>& wall_names)
{
    const std::string both =
        approach.wall < 0 ? name_spheres(approach.sphere, approach.other)
                          : name_sphere_and_wall(approach.sphere, wall_names[static_cast<std::size_t>(approach.wall)]);
    return fmt::format("{}, which close at {:.3g} m/s", both, approach.speed);
}

std::string describe(const Incident& incident, const std::vector<std::string>& wall_names)
{
    if (incident.kind == Incident::Kind::pressed) return describe_press(incident, wall_names);
    if (incident.kind == Incident::Kind::appeared_inside) return describe_wall_inside(incident, wall_names);
    const auto& x = incident.position;
    if (incident.of_piston())
        return fmt::format("the wall '{}' {}: its middle is at ({:.4g}, {:.4g}, {:.4g}) m with {:.4g} m/s",
            wall_names[static_cast<std::size_t>(incident.last_wall)], sentence_of(incident.kind), x.x(), x.y(), x.z(),
            incident.speed);
    const std::string touched = incident.last_wall < 0 ? "it has touched no wall"
                                                       : fmt::format("the wall it touched last is '{}'",
                                                             wall_names[static_cast<std::size_t>(incident.last_wall)]);
    return fmt::format("sphere {} {}: it is at ({:.4g}, {:.4g}, {:.4g}) m with {:.4g} m/s, and {}", incident.id,
        sentence_of(incident.kind), x.x(), x.y(), x.z(), incident.speed, touched);
}

std::string incidents_text(const std::vector<Incident>& incidents, const std::vector<std::string>& wall_names)
{
    return text_of(to_json(incidents, wall_names));
}

std::string summary_text(const RunSummary& summary)
{
    const char* status = !summary.incidents.empty() ? "failed" : summary.interrupted ? "interrupted" : "done";
    Json error = to_json(summary.error, summary.wall_names);
    error["solver"] = to_json(summary.solver_error);
    error["companions"] = {{"pieces", summary.companion_pieces}, {"length", summary.companion_length}};
    return text_of({{"status", status}, {"touched", summary.touched},
        {"incidents", to_json(summary.incidents, summary.wall_names)}, {"version", summary.version},
        {"scene", summary.scene}, {"title", summary.title}, {"seed", summary.seed},
        {"explanations", to_json(summary.explanations)}, {"threads", summary.threads},
        {"time", {{"simulated", summary.simulated_time}, {"step", summary.time_step}, {"steps", summary.steps}}},
        {"ledger", to_json(summary.ledger)}, {"pours", to_json(summary.pours)}, {"sensors", to_json(summary.sensors)},
        {"error", error}, {"timing", to_json(summary.timing)}});
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary)
{
    write_atomically(path, summary_text(summary));
}

} // namespace talus
