// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/study_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

constexpr double width = 460, height = 320;                    ///< of a chart [px]
constexpr double left = 62, right = 14, top = 12, bottom = 44; ///< margins round its axes [px]

constexpr const char* style = R"(<style>
:root { color-scheme: light dark; --ink: #1d2430; --soft: #68707d; --line: #d9dde3; --back: #fff; --front: #b4451f;
  --matched: #2f6fb0; --projected: #2e8b57; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7ec; --soft: #9aa3b0; --line: #3a414c; --back: #171b21;
  --front: #f08a5d; --matched: #74aee8; --projected: #6fce9b; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--back); margin: 2rem auto;
  max-width: 1000px; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin-bottom: .2rem; } h2 { font-size: 1.15rem; margin-top: 2rem; }
p, li { max-width: 50rem; } .soft { color: var(--soft); }
.charts { display: flex; flex-wrap: wrap; gap: 1rem 2rem; } figure { margin: 0; }
figcaption { max-width: 460px; } figcaption b { font-weight: 600; }
svg text { font: 11px system-ui, sans-serif; fill: var(--soft); } svg .name { fill: var(--ink); }
.axis { stroke: var(--line); } .front { stroke: var(--front); fill: none; stroke-width: 1.5; }
.matched { fill: var(--matched); } .projected { fill: var(--projected); }
.ring { fill: none; stroke: var(--front); stroke-width: 2; } .bar { stroke: var(--soft); }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: 12px; }
td, th { padding: .2rem .5rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
td:first-child, th:first-child { text-align: left; } th { font-weight: 600; vertical-align: bottom; }
</style>
)";

std::string escaped(const std::string& text)
{
    std::string html;
    for (const char c : text) {
        if (c == '<')
            html += "&lt;";
        else if (c == '>')
            html += "&gt;";
        else if (c == '&')
            html += "&amp;";
        else
            html += c;
    }
    return html;
}

/// A logarithmic axis over whole decades.
struct LogAxis {
    double first = 1.0, last = 10.0; ///< powers of ten
    double begin = 0.0, end = 1.0;   ///< where these are [px]

    LogAxis(const std::vector<double>& values, double from, double to) : begin(from), end(to)
    {
        double least = infinity, most = 0.0;
        for (const double value : values)
            if (value > 0.0 && std::isfinite(value)) {
                least = std::min(least, value);
                most = std::max(most, value);
            }
        if (most == 0.0) least = most = 1.0;
        first = std::floor(std::log10(least) - 0.05);
        last = std::max(first + 1.0, std::ceil(std::log10(most) + 0.05));
    }

    double place(double value) const
    {
        const double decades = std::clamp(std::log10(std::max(value, 1e-300)), first, last);
        return begin + (end - begin) * (decades - first) / (last - first);
    }
};

std::string tick_text(double decade)
{
    return std::abs(decade) <= 3.0 ? fmt::format("{:g}", std::pow(10.0, decade)) : fmt::format("1e{:g}", decade);
}

std::string axes(const LogAxis& x, const LogAxis& y, const ErrorKind& kind)
{
    std::string svg;
    const double step_y = std::max(1.0, std::ceil((y.last - y.first) / 7.0));
    for (double decade = x.first; decade <= x.last; ++decade) {
        const double at = x.place(std::pow(10.0, decade));
        svg += fmt::format("<line class=axis x1={0:.1f} x2={0:.1f} y1={1} y2={2} /><text x={0:.1f} y={3} "
                           "text-anchor=middle>{4}</text>\n",
            at, top, height - bottom, height - bottom + 16, tick_text(decade));
    }
    for (double decade = y.first; decade <= y.last; decade += step_y) {
        const double at = y.place(std::pow(10.0, decade));
        svg += fmt::format("<line class=axis x1={1} x2={2} y1={0:.1f} y2={0:.1f} /><text x={3} y={4:.1f} "
                           "text-anchor=end>{5}</text>\n",
            at, left, width - right, left - 6, at + 4, tick_text(decade));
    }
    svg += fmt::format("<text x={:.1f} y={} text-anchor=middle>CPU seconds for a simulated second</text>\n",
        0.5 * (left + width - right), height - 8);
    const std::string unit = kind.unit == "1" ? "relative" : kind.unit;
    svg += fmt::format("<text transform='translate(12 {:.1f}) rotate(-90)' text-anchor=middle>{}</text>\n",
        0.5 * (top + height - bottom), escaped(unit));
    return svg;
}

const char* law_of(const std::string& setting)
{
    return setting.find("projected") == std::string::npos ? "matched" : "projected";
}

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.2g}", value) : "–";
}

std::string point(const StudyResult& result, std::size_t i, std::size_t kind, const LogAxis& x, const LogAxis& y)
{
    const StudyPoint& p = result.points[i];
    const ErrorValue& error = p.errors[kind];
    const double at_x = x.place(p.cpu), at_y = y.place(error.value);
    std::string svg;
    if (error.spread > 0.0)
        svg += fmt::format("<line class=bar x1={0:.1f} x2={0:.1f} y1={1:.1f} y2={2:.1f} />\n", at_x,
            y.place(error.value - 1.96 * error.spread), y.place(error.value + 1.96 * error.spread));
    if (i == 1) svg += fmt::format("<circle class=ring cx={:.1f} cy={:.1f} r=8 />\n", at_x, at_y);
    svg += fmt::format("<circle class={} cx={:.1f} cy={:.1f} r=4><title>{}: {} at {:.3g} s</title></circle>\n",
        law_of(p.setting), at_x, at_y, escaped(p.setting), number(error.value), p.cpu);
    return svg;
}

std::string front_line(const StudyResult& result, std::size_t kind, const LogAxis& x, const LogAxis& y)
{
    std::string path;
    double before = 0.0;
    for (const std::size_t i : front(result, kind)) {
        const StudyPoint& p = result.points[i];
        const double at_x = x.place(p.cpu), at_y = y.place(p.errors[kind].value);
        path += path.empty() ? fmt::format("M{:.1f} {:.1f}", at_x, at_y)
                             : fmt::format(" L{:.1f} {:.1f} L{:.1f} {:.1f}", at_x, before, at_x, at_y);
        before = at_y;
    }
    return path.empty() ? "" : fmt::format("<path class=front d='{}' />\n", path);
}

/// The settings on the front have their names beside them, where there is room; the others under the mouse.
std::string names(const StudyResult& result, std::size_t kind, const LogAxis& x, const LogAxis& y)
{
    constexpr double line_height = 12, letter_width = 5.6; // px
    struct Label {
        double begin, end, y;
    };
    std::vector<Label> placed;
    std::string svg;
    for (const std::size_t i : front(result, kind)) {
        const StudyPoint& p = result.points[i];
        const double at_x = x.place(p.cpu), at_y = y.place(p.errors[kind].value) - 6;
        const bool to_the_left = at_x > 0.5 * width;
        const double length = letter_width * static_cast<double>(p.setting.size());
        const Label label = {
            to_the_left ? at_x - 9 - length : at_x + 9, to_the_left ? at_x - 9 : at_x + 9 + length, at_y};
        if (std::ranges::any_of(placed, [&](const Label& other) {
                return std::abs(label.y - other.y) < line_height && label.begin < other.end && other.begin < label.end;
            }))
            continue;
        placed.push_back(label);
        svg += fmt::format("<text class=name x={:.1f} y={:.1f} text-anchor={}>{}</text>\n",
            to_the_left ? label.end : label.begin, at_y, to_the_left ? "end" : "start", escaped(p.setting));
    }
    return svg;
}

std::string chart(const StudyResult& result, std::size_t kind)
{
    std::vector<double> cpu, errors;
    for (std::size_t i = 1; i < result.points.size(); ++i) {
        if (!result.points[i].is_done()) continue;
        cpu.push_back(result.points[i].cpu);
        errors.push_back(result.points[i].errors[kind].value);
    }
    const LogAxis x(cpu, left, width - right), y(errors, height - bottom, top);
    std::string svg = axes(x, y, result.kinds[kind]) + front_line(result, kind, x, y);
    for (std::size_t i = 1; i < result.points.size(); ++i)
        if (result.points[i].is_done() && std::isfinite(result.points[i].errors[kind].value))
            svg += point(result, i, kind, x, y);
    svg += names(result, kind, x, y);
    return fmt::format("<figure><figcaption><b>{}</b> <span class=soft>{}</span></figcaption>\n<svg width={} height={} "
                       "viewBox='0 0 {} {}' role=img>\n{}</svg></figure>\n",
        escaped(result.kinds[kind].name), escaped(result.kinds[kind].meaning), width, height, width, height, svg);
}

bool has_something_to_show(const StudyResult& result, std::size_t kind)
{
    return std::ranges::any_of(result.points, [&](const StudyPoint& p) {
        return p.is_done() && std::isfinite(p.errors[kind].value) && p.errors[kind].value > 0.0;
    });
}

std::string table(const StudyResult& result)
{
    std::string html = "<div class=scroll><table><tr><th>setting<th>CPU s / s<th>contact updates / s<th>MB";
    for (const ErrorKind& kind : result.kinds)
        html += fmt::format(
            "<th>{}<br><span class=soft>{}</span>", escaped(kind.name), escaped(kind.unit == "1" ? "" : kind.unit));
    html += "\n";
    for (const StudyPoint& p : result.points) {
        html += fmt::format("<tr><td>{}", escaped(p.setting));
        if (!p.is_done()) {
            html +=
                fmt::format("<td colspan={} style='text-align:left'>{}\n", 3 + result.kinds.size(), escaped(p.status));
            continue;
        }
        html += fmt::format("<td>{:.3g}<td>{:.2e}<td>{:.0f}", p.cpu, p.updates, 1e-6 * p.memory);
        for (const ErrorValue& error : p.errors)
            html += fmt::format(
                "<td>{}{}", number(error.value), error.spread > 0.0 ? fmt::format(" ± {:.1g}", error.spread) : "");
        html += "\n";
    }
    return html + "</table></div>\n";
}

} // namespace

std::string study_csv(const StudyResult& result)
{
    std::string csv = "setting,status,cpu_s_per_s,contact_updates_per_s,memory_B";
    for (const ErrorKind& kind : result.kinds) {
        std::string name = kind.name;
        std::ranges::replace(name, ' ', '_');
        csv += fmt::format(",{0},{0}_spread", name);
    }
    csv += "\n";
    for (const StudyPoint& p : result.points) {
        std::string status = p.status;
        std::ranges::replace(status, '"', '\'');
        csv += fmt::format("\"{}\",\"{}\",{:.6g},{:.6g},{:.0f}", p.setting, status, p.cpu, p.updates, p.memory);
        for (std::size_t k = 0; k < result.kinds.size(); ++k)
            csv += p.is_done() ? fmt::format(",{:.6g},{:.3g}", p.errors[k].value, p.errors[k].spread) : ",,";
        csv += "\n";
    }
    return csv;
}

std::string study_page(const StudyResult& result, const PageHead& head)
{
    std::string advices, charts;
    for (const std::string& sentence : advice(result)) advices += fmt::format("<li>{}\n", escaped(sentence));
    for (std::size_t kind = 0; kind < result.kinds.size(); ++kind)
        if (has_something_to_show(result, kind)) charts += chart(result, kind);
    return fmt::format(
        "<!doctype html>\n<html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width'>\n"
        "<title>Study: {0}</title>\n{1}<h1>{0}</h1>\n<p class=soft>{2}</p>\n<h2>Advice</h2>\n<ul>\n{3}</ul>\n"
        "<h2>Error against cost</h2>\n<p class=soft>A point is a setting, <span style='color:var(--matched)'>matched"
        "</span> or <span style='color:var(--projected)'>projected</span>; its name appears under the mouse. The ring "
        "is "
        "the default, bars are 95 % intervals, and the line joins the settings for which no cheaper one has as small "
        "an "
        "error.</p>\n<div class=charts>\n{4}</div>\n<h2>All settings</h2>\n{5}</html>\n",
        escaped(head.title), style, escaped(head.what), advices, charts, table(result));
}

} // namespace talus
