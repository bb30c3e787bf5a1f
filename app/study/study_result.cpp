// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/study_result.hpp"

#include "core/base/statistics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace talus
{
namespace
{

constexpr double sure = 1.96; ///< standard errors
constexpr double sensor_target = 0.01;
constexpr double notably_cheaper = 0.95; ///< CPU times scatter by some per cent
constexpr double stands_out = 5.0;       ///< standard errors
constexpr std::size_t most_names = 6;    ///< in one sentence

/// What a run tells of itself.
const std::vector<ErrorKind> own_kinds = {
    {"velocity_error", "sqrt(g d)", "velocities after one step, against the same step solved to the end; mean of three",
        false, true},
    {"residual", "1", "relative residual of the steps, mean"},
    {"residual_95", "1", "95 % of the steps have less"},
    {"steps_at_cap", "1", "share of the steps that stopped at the cap of sweeps"},
    {"overlap", "d", "mean over the loaded contacts that overlap"},
    {"overlap_95", "d", "95 % of them have less", false, true},
    {"worst_overlap", "d", "at any look"},
    {"energy_gained", "M g d/s", "rises of the energy that nothing put in"},
    {"momentum_error", "M g h", "worst step: gain of momentum less gravity and walls"},
};

/// What a run should share with the reference.
const std::vector<ErrorKind> shared_kinds = {
    {"height", "d", "of the packing (twice that of the centre of mass), against the reference"},
    {"creep", "d/s", "median way of the spheres by the time, against the reference", false, true},
    {"restlessness", "m g d", "kinetic energy of a sphere without the liveliest 2 %, against the reference"},
    {"support_swing", "M g", "rms swing of the force by walls, against the reference"},
};

const ErrorKind profile_kind = {"force_profile", "M g",
    "mean force by walls and through level cuts, the worst of them, against the reference", false, true};

const Measurement* find(const StudyRow& row, const std::string& name)
{
    const auto found = std::ranges::find(row.findings, name, &Measurement::name);
    return found == row.findings.end() ? nullptr : &*found;
}

bool is_named_in(const std::vector<ErrorKind>& kinds, const std::string& name)
{
    return std::ranges::find(kinds, name, &ErrorKind::name) != kinds.end();
}

std::vector<ErrorKind> kinds_of(const StudyRow& reference)
{
    std::vector<ErrorKind> kinds = own_kinds;
    kinds.insert(kinds.end(), shared_kinds.begin(), shared_kinds.end());
    kinds.push_back(profile_kind);
    for (const Measurement& m : reference.findings) {
        if (is_named_in(kinds, m.name)) continue;
        const std::string meaning =
            fmt::format("of the sensor, as a share of the reference's {:.4g} {}", m.value, m.unit);
        kinds.push_back({m.name, "1", meaning, true, std::abs(m.value) > stands_out * m.spread});
    }
    return kinds;
}

double worst_difference(const std::vector<double>& one, const std::vector<double>& other)
{
    double worst = 0.0;
    for (std::size_t k = 0; k < std::min(one.size(), other.size()); ++k)
        worst = std::max(worst, std::abs(one[k] - other[k]));
    return worst;
}

/// The signed error of a kind in one row; not a number where it cannot be told.
ErrorValue error_in(const StudyRow& row, const StudyRow& reference, const ErrorKind& kind)
{
    const double unknown = std::nan("");
    if (kind.name == profile_kind.name) return {worst_difference(row.profile, reference.profile), 0.0};
    const Measurement* m = find(row, kind.name);
    if (!m) return {unknown, unknown};
    const auto known = [](double spread) { return std::isfinite(spread) ? spread : 0.0; };
    if (is_named_in(own_kinds, kind.name)) return {m->value, known(m->spread)};
    const Measurement* r = find(reference, kind.name);
    if (!r) return {unknown, unknown};
    const double unit = kind.of_sensor ? std::abs(r->value) : 1.0;
    return {(m->value - r->value) / unit, std::hypot(known(m->spread), known(r->spread)) / unit};
}

const StudyRow* find_row(const std::vector<StudyRow>& rows, const std::string& setting, std::int64_t seed)
{
    const auto found =
        std::ranges::find_if(rows, [&](const StudyRow& row) { return row.setting == setting && row.seed == seed; });
    return found == rows.end() ? nullptr : &*found;
}

ErrorValue over_seeds(const std::vector<ErrorValue>& errors)
{
    MeanAndError mean;
    double squares = 0.0;
    for (const ErrorValue& error : errors) {
        mean.add(error.value);
        squares += error.spread * error.spread;
    }
    const double own = std::sqrt(squares) / static_cast<double>(errors.size());
    const double scatter = errors.size() > 1 ? mean.standard_error() : 0.0;
    return {std::abs(mean.mean()), std::max(own, scatter)};
}

StudyPoint point_of(const Setting& setting, const std::vector<StudyRow>& rows, const std::vector<ErrorKind>& kinds)
{
    StudyPoint point{.setting = setting.name};
    std::vector<std::vector<ErrorValue>> errors(kinds.size());
    double count = 0.0;
    for (const StudyRow& row : rows) {
        if (row.setting != setting.name) continue;
        const StudyRow* reference = find_row(rows, reference_name, row.seed);
        if (row.status != "done") point.status = row.status;
        if (row.status != "done" || !reference || reference->status != "done") continue;
        count += 1.0;
        point.cpu += row.cpu;
        point.updates += row.updates;
        point.memory = std::max(point.memory, row.memory);
        for (std::size_t k = 0; k < kinds.size(); ++k) errors[k].push_back(error_in(row, *reference, kinds[k]));
    }
    if (count == 0.0 && point.is_done()) point.status = "not run, or without a reference";
    if (!point.is_done()) return point;
    point.cpu /= count;
    point.updates /= count;
    for (const auto& of_kind : errors) point.errors.push_back(over_seeds(of_kind));
    return point;
}

/// Whether two settings came to the same bits for every seed: then they are one.
bool are_the_same_run(const std::vector<StudyRow>& rows, const std::string& one, const std::string& other)
{
    const auto same_number = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    const auto same = [&](const Measurement& a, const Measurement& b) { return same_number(a.value, b.value); };
    return std::ranges::all_of(rows, [&](const StudyRow& row) {
        if (row.setting != one) return true;
        const StudyRow* match = find_row(rows, other, row.seed);
        return match && row.updates == match->updates && std::ranges::equal(row.findings, match->findings, same);
    });
}

/// The cheapest setting, but the reference, that the question is true of.
std::optional<std::size_t> cheapest(const StudyResult& result, auto&& is_good)
{
    std::optional<std::size_t> best;
    for (std::size_t i = 1; i < result.points.size(); ++i) {
        const StudyPoint& point = result.points[i];
        if (point.is_done() && is_good(point) && (!best || point.cpu < result.points[*best].cpu)) best = i;
    }
    return best;
}

std::string in_unit(double value, const std::string& unit)
{
    return unit == "1" ? fmt::format("{:.2g}", value) : fmt::format("{:.2g} {}", value, unit);
}

/// "use X: 2.1 x faster than the default", or that the default it is.
/// @param default_is_good the default will do as well
std::string choice(const StudyResult& result, std::size_t best, bool default_is_good)
{
    const StudyPoint& point = result.points[best];
    const double ratio = result.standard().cpu / point.cpu;
    const bool costs_as_much = best == 1 || std::abs(1.0 / ratio - 1.0) < 1.0 - notably_cheaper;
    if (costs_as_much && default_is_good) return "nothing that was tried is notably cheaper than the default";
    if (costs_as_much) return fmt::format("use {}: it takes as long as the default", point.setting);
    return ratio >= 1.0 ? fmt::format("use {}: {:.2g} × faster than the default", point.setting, ratio)
                        : fmt::format("use {}: it takes {:.2g} × as long as the default", point.setting, 1.0 / ratio);
}

std::string advice_for_default(const StudyResult& result, std::size_t kind)
{
    const ErrorValue had = result.standard().errors[kind];
    const auto best = cheapest(result, [&](const StudyPoint& p) { return p.errors[kind].value <= had.value; });
    return fmt::format("For no more {} than the default's {}: {}.", result.kinds[kind].name,
        in_unit(had.value, result.kinds[kind].unit), choice(result, best.value_or(1), true));
}

/// Nowhere worse: of what a difference is known to, only what is above that counts.
std::string advice_for_all(const StudyResult& result)
{
    const StudyPoint& standard = result.standard();
    const auto best = cheapest(result, [&](const StudyPoint& p) {
        for (std::size_t kind = 0; kind < result.kinds.size(); ++kind) {
            const ErrorValue &error = p.errors[kind], &had = standard.errors[kind];
            if (result.kinds[kind].advised && error.value > had.value + sure * std::hypot(error.spread, had.spread))
                return false;
        }
        return true;
    });
    return fmt::format("To be nowhere worse than the default: {}.", choice(result, best.value_or(1), true));
}

/// "one, two, three and 40 more"
std::string first_of(const std::vector<std::string>& names)
{
    const std::size_t shown = std::min(names.size(), most_names);
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
    return text;
}

/// What goes for sensors, each choice in one sentence with all the measures that it is right for.
std::vector<std::string> advice_for_sensors(const StudyResult& result)
{
    std::vector<std::pair<std::string, std::vector<std::string>>> choices;
    std::vector<std::string> unsure;
    for (std::size_t kind = 0; kind < result.kinds.size(); ++kind) {
        const std::string& name = result.kinds[kind].name;
        const ErrorValue had = result.standard().errors[kind];
        if (!result.kinds[kind].of_sensor || !result.kinds[kind].advised || !std::isfinite(had.value)) continue;
        const auto is_good = [&](const StudyPoint& p) {
            return p.errors[kind].value + sure * p.errors[kind].spread <= sensor_target;
        };
        const auto best = cheapest(result, is_good);
        if (!best) {
            unsure.push_back(fmt::format(
                "{} (the default differs by {:.2g} ± {:.2g} %)", name, 100.0 * had.value, 100.0 * sure * had.spread));
            continue;
        }
        const std::string chosen = choice(result, *best, is_good(result.standard()));
        auto with_it = std::ranges::find(choices, chosen, [](const auto& pair) { return pair.first; });
        if (with_it == choices.end()) with_it = choices.insert(choices.end(), {chosen, {}});
        with_it->second.push_back(name);
    }
    std::vector<std::string> sentences;
    for (const auto& [chosen, names] : choices)
        sentences.push_back(fmt::format("For 1 % in {}: {}.", first_of(names), chosen));
    if (!unsure.empty())
        sentences.push_back(fmt::format(
            "No setting is sure to be within 1 % in {}; more seeds or a longer time tell more.", first_of(unsure)));
    return sentences;
}

} // namespace

StudyResult compare(const std::vector<Setting>& settings, const std::vector<StudyRow>& rows)
{
    StudyResult result;
    const auto reference = std::ranges::find_if(
        rows, [](const StudyRow& row) { return row.setting == reference_name && row.status == "done"; });
    if (reference != rows.end()) result.kinds = kinds_of(*reference);
    for (const Setting& setting : settings) {
        StudyPoint point = point_of(setting, rows, result.kinds);
        const auto twin = std::ranges::find_if(result.points, [&](const StudyPoint& earlier) {
            return point.is_done() && earlier.is_done() && are_the_same_run(rows, point.setting, earlier.setting);
        });
        if (twin != result.points.end()) {
            point.status = fmt::format("the same run as {}", twin->setting);
            twin->cpu += (point.cpu - twin->cpu) / ++twin->equal_settings;
        }
        result.points.push_back(point);
    }
    return result;
}

std::vector<std::size_t> front(const StudyResult& result, std::size_t kind)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 1; i < result.points.size(); ++i)
        if (result.points[i].is_done() && std::isfinite(result.points[i].errors[kind].value)) order.push_back(i);
    const auto error = [&](std::size_t i) { return result.points[i].errors[kind].value; };
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        return std::pair(result.points[a].cpu, error(a)) < std::pair(result.points[b].cpu, error(b));
    });
    std::vector<std::size_t> best;
    for (const std::size_t i : order)
        if (best.empty() || error(i) < error(best.back())) best.push_back(i);
    return best;
}

std::vector<std::string> advice(const StudyResult& result)
{
    std::vector<std::string> sentences;
    if (result.points.size() < 2 || !result.standard().is_done()) return sentences;
    sentences.push_back(advice_for_all(result));
    for (std::size_t kind = 0; kind < result.kinds.size(); ++kind)
        if (result.kinds[kind].advised && !result.kinds[kind].of_sensor &&
            std::isfinite(result.standard().errors[kind].value))
            sentences.push_back(advice_for_default(result, kind));
    std::ranges::copy(advice_for_sensors(result), std::back_inserter(sentences));
    return sentences;
}

} // namespace talus
