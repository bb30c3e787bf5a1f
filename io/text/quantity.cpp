// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/quantity.hpp"

#include "io/text/input_file.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace talus
{
namespace
{

/// A unit in kilograms, metres, seconds and radians; angles are told apart from numbers, so that turns in a minute are
/// a speed of rotation and no frequency.
struct Unit {
    long double factor = 1.0L;   ///< with digits to spare, so that 2.5 g/cm3 are 2500 kg/m3
    std::array<int, 4> powers{}; ///< of kg, m, s, rad

    void multiply_by(const Unit& other, int power)
    {
        factor *= std::pow(other.factor, power);
        for (std::size_t k = 0; k < powers.size(); ++k) powers[k] += power * other.powers[k];
    }
};

constexpr std::array<int, 4> mass{1, 0, 0, 0}, length{0, 1, 0, 0}, time{0, 0, 1, 0}, angle{0, 0, 0, 1},
    force{1, 1, -2, 0}, energy{1, 2, -2, 0}, pressure{1, -1, -2, 0}, volume{0, 3, 0, 0}, rate{0, 0, -1, 0},
    turning{0, 0, -1, 1};
constexpr long double turn = 2.0L * std::numbers::pi_v<long double>;

constexpr std::pair<std::string_view, Unit> units[] = {{"m", {1.0L, length}}, {"km", {1e3L, length}},
    {"dm", {1e-1L, length}}, {"cm", {1e-2L, length}}, {"mm", {1e-3L, length}}, {"um", {1e-6L, length}},
    {"µm", {1e-6L, length}}, {"in", {0.0254L, length}}, {"kg", {1.0L, mass}}, {"g", {1e-3L, mass}},
    {"mg", {1e-6L, mass}}, {"t", {1e3L, mass}}, {"s", {1.0L, time}}, {"ms", {1e-3L, time}}, {"us", {1e-6L, time}},
    {"µs", {1e-6L, time}}, {"min", {60.0L, time}}, {"h", {3600.0L, time}}, {"N", {1.0L, force}}, {"mN", {1e-3L, force}},
    {"kN", {1e3L, force}}, {"MN", {1e6L, force}}, {"µN", {1e-6L, force}}, {"uN", {1e-6L, force}}, {"J", {1.0L, energy}},
    {"mJ", {1e-3L, energy}}, {"Pa", {1.0L, pressure}}, {"kPa", {1e3L, pressure}}, {"MPa", {1e6L, pressure}},
    {"GPa", {1e9L, pressure}}, {"l", {1e-3L, volume}}, {"ml", {1e-6L, volume}}, {"µl", {1e-9L, volume}},
    {"ul", {1e-9L, volume}}, {"nl", {1e-12L, volume}}, {"Hz", {1.0L, rate}}, {"kHz", {1e3L, rate}},
    {"rad", {1.0L, angle}}, {"deg", {turn / 360, angle}}, {"°", {turn / 360, angle}}, {"rpm", {turn / 60, turning}},
    {"1", {1.0L, {}}}};

std::string_view without_spaces_before(std::string_view text)
{
    return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

/// Takes a word off the text, if it begins with it.
bool take(std::string_view& text, std::string_view word)
{
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

/// The power behind the name of a unit, 1 where there is none.
int take_power(std::string_view& text)
{
    if (take(text, "²")) return 2;
    if (take(text, "³")) return 3;
    take(text, "^");
    const int sign = take(text, "-") ? -1 : 1;
    if (text.empty() || text.front() < '1' || text.front() > '9') return 1;
    const int power = text.front() - '0';
    text.remove_prefix(1);
    return sign * power;
}

/// The unit whose name the text begins with, the longest that fits, with its power.
std::optional<Unit> take_factor(std::string_view& text)
{
    const std::pair<std::string_view, Unit>* best = nullptr;
    for (const auto& known : units)
        if (text.starts_with(known.first) && (!best || known.first.size() > best->first.size())) best = &known;
    if (!best) return std::nullopt;
    text.remove_prefix(best->first.size());
    Unit unit;
    unit.multiply_by(best->second, best->first == "1" ? 1 : take_power(text));
    return unit;
}

std::optional<Unit> read_unit(std::string_view text)
{
    Unit unit;
    int sign = 1;
    for (bool first = true; first || !text.empty(); first = false) {
        text = without_spaces_before(text);
        if (!first && take(text, "/"))
            sign = -1;
        else if (!first && (take(text, "*") || take(text, "·")))
            sign = 1;
        text = without_spaces_before(text);
        const auto factor = take_factor(text);
        if (!factor) return std::nullopt;
        unit.multiply_by(*factor, sign);
        sign = 1;
        if (!text.empty() && text.find_first_of(" /*") != 0 && !text.starts_with("·")) return std::nullopt;
    }
    return unit;
}

/// The number with which a text begins, and what comes behind it.
std::optional<std::pair<double, std::string_view>> split(std::string_view text)
{
    for (std::size_t size = text.size(); size > 0; --size)
        if (const auto number = finite_number(text.substr(0, size)); number && text[size - 1] != ' ')
            return std::pair{*number, text.substr(size)};
    return std::nullopt;
}

} // namespace

std::optional<double> quantity_in(std::string_view text, std::string_view unit)
{
    const auto parts = split(text);
    if (!parts) return std::nullopt;
    const auto given = read_unit(parts->second), wanted = read_unit(unit);
    if (!given || !wanted || given->powers != wanted->powers) return std::nullopt;
    return static_cast<double>(parts->first * given->factor / wanted->factor);
}

std::string known_units()
{
    std::string text;
    for (const auto& [name, unit] : units)
        if (name != "1") text += std::string(text.empty() ? "" : ", ") + std::string(name);
    return text + ", and their products, quotients and powers, as in \"2.5 g/cm3\" or \"9.81 m/s^2\"";
}

bool is_quantity(std::string_view text)
{
    const auto parts = split(text);
    return parts && read_unit(parts->second);
}

} // namespace talus
