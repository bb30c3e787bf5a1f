// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace talus::test
{
namespace
{

std::string text(double number)
{
    std::ostringstream out;
    out.precision(3);
    out << number;
    return out.str();
}

} // namespace

HardCase::HardCase(std::string name) : name_(std::move(name)), exceptions_(std::uncaught_exceptions()) {}

HardCase::~HardCase()
{
    const char* folder = std::getenv("TALUS_HARD_RESULTS");
    if (!folder) return;
    if (std::uncaught_exceptions() > exceptions_) rows_.push_back({"comes to its end", "stopped early", "FAILED"});
    const double seconds = static_cast<double>(std::clock() - began_) / CLOCKS_PER_SEC;
    std::ofstream out(std::filesystem::path(folder) / (name_ + ".tsv"));
    for (const auto& row : rows_)
        out << name_ << '\t' << row.criterion << '\t' << row.measured << '\t' << row.verdict << '\t' << text(seconds)
            << '\n';
}

void HardCase::below(const std::string& what, double measured, double limit)
{
    INFO(what);
    CHECK(measured < limit);
    add(what + " < " + text(limit), text(measured), measured < limit);
}

void HardCase::should_be_below(const std::string& what, double measured, double limit)
{
    INFO(what);
    CHECK_NOFAIL(measured < limit);
    add(what + " < " + text(limit), text(measured), measured < limit);
}

void HardCase::above(const std::string& what, double measured, double limit)
{
    INFO(what);
    CHECK(measured > limit);
    add(what + " > " + text(limit), text(measured), measured > limit);
}

void HardCase::between(const std::string& what, double measured, double least, double most)
{
    INFO(what);
    CHECK(measured >= least);
    CHECK(measured <= most);
    add(what + " in " + text(least) + " … " + text(most), text(measured), measured >= least && measured <= most);
}

void HardCase::holds(const std::string& what, bool held)
{
    INFO(what);
    CHECK(held);
    add(what, held ? "yes" : "no", held);
}

void HardCase::tell(const std::string& what, double measured)
{
    tell(what, text(measured));
}

void HardCase::tell(const std::string& what, const std::string& answer)
{
    rows_.push_back({what, answer, "told"});
}

void HardCase::add(const std::string& criterion, const std::string& measured, bool passed)
{
    rows_.push_back({criterion, measured, passed ? "ok" : "FAILED"});
}

} // namespace talus::test
