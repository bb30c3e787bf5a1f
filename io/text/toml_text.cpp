// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/toml_text.hpp"

#include <cmath>

namespace talus
{

/// As a float even where it is whole.
std::string toml_text(double number)
{
    std::string text = fmt::format("{}", number);
    if (std::isfinite(number) && text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string toml_text(bool truth)
{
    return truth ? "true" : "false";
}

std::string toml_text(std::int64_t number)
{
    return fmt::format("{}", number);
}

std::string toml_text(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += fmt::format("\\{}", c);
        else if ((c >= 0 && c < ' ') || c == 0x7f)
            quoted += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            quoted += c;
    }
    return quoted + '"';
}

std::string toml_text(const Vec3& vector)
{
    return fmt::format("[{}, {}, {}]", toml_text(vector.x()), toml_text(vector.y()), toml_text(vector.z()));
}

std::string toml_text(const scene::NumberOrName& value)
{
    return value.name.empty() ? toml_text(value.number) : toml_text(value.name);
}

std::string toml_text(const scene::SwitchOrName& value)
{
    return value.name.empty() ? toml_text(value.on) : toml_text(value.name);
}

std::string toml_text(const std::vector<std::string>& list)
{
    std::string text;
    for (const std::string& element : list) text += (text.empty() ? "" : ", ") + toml_text(element);
    return "[" + text + "]";
}

std::string toml_text(const std::vector<scene::Waypoint>& table)
{
    std::string text;
    for (const scene::Waypoint& at : table)
        text += fmt::format("{}[{}, {}, {}, {}]", text.empty() ? "" : ", ", toml_text(at.time), toml_text(at.shift.x()),
            toml_text(at.shift.y()), toml_text(at.shift.z()));
    return "[" + text + "]";
}

/// A load that never changes is a number, as in a scene.
std::string toml_text(const std::vector<scene::LoadRow>& load)
{
    if (load.size() == 1 && load[0].time == 0.0) return toml_text(load[0].force);
    std::string text;
    for (const scene::LoadRow& row : load)
        text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", toml_text(row.time), toml_text(row.force));
    return "[" + text + "]";
}

} // namespace talus
