// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/property.hpp"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <vector>

namespace talus::test
{
namespace
{

constexpr std::uint64_t noted_every = 500; ///< worlds
constexpr std::size_t most_kept = 200;     ///< seeds
constexpr double most_unsolved = 0.01;     ///< share

std::string environment(const char* name, const std::string& otherwise)
{
    const char* value = std::getenv(name);
    return value ? value : otherwise;
}

struct Tally {
    std::uint64_t looked_at = 0, holds = 0, fails = 0, unsolved = 0, no_room = 0, left_out = 0, must_solve = 0;
    double largest = -1e300;      ///< measure …
    std::uint64_t largest_of = 0; ///< … and the seed of that world
    std::vector<std::uint64_t> failed, not_solved;

    void add(std::uint64_t seed, const Verdict& verdict)
    {
        ++looked_at;
        switch (verdict.outcome) {
        case Verdict::Outcome::holds:
            ++holds;
            break;
        case Verdict::Outcome::fails:
            ++fails;
            if (failed.size() < most_kept) failed.push_back(seed);
            break;
        case Verdict::Outcome::unsolved:
            ++unsolved;
            must_solve += verdict.must_solve;
            if (not_solved.size() < most_kept) not_solved.push_back(seed);
            break;
        case Verdict::Outcome::no_room:
            ++no_room;
            break;
        case Verdict::Outcome::left_out:
            ++left_out;
            break;
        }
        const bool counts = verdict.outcome == Verdict::Outcome::holds || verdict.outcome == Verdict::Outcome::fails;
        if (counts && verdict.measure > largest) {
            largest = verdict.measure;
            largest_of = seed;
        }
    }

    void write(std::ostream& out) const
    {
        out.precision(17);
        out << looked_at << ' ' << holds << ' ' << fails << ' ' << unsolved << ' ' << no_room << ' ' << left_out << ' '
            << must_solve << ' ' << largest << ' ' << largest_of << '\n';
        for (const auto* seeds : {&failed, &not_solved}) {
            out << seeds->size();
            for (const std::uint64_t seed : *seeds) out << ' ' << seed;
            out << '\n';
        }
    }

    void read(std::istream& in)
    {
        in >> looked_at >> holds >> fails >> unsolved >> no_room >> left_out >> must_solve >> largest >> largest_of;
        for (auto* seeds : {&failed, &not_solved}) {
            std::size_t count = 0;
            in >> count;
            seeds->resize(std::min(count, most_kept));
            for (std::uint64_t& seed : *seeds) in >> seed;
        }
    }

    std::string told() const
    {
        std::ostringstream text;
        text.precision(3);
        text << looked_at << " worlds: " << holds << " hold, " << fails << " fail, " << unsolved << " unsolved ("
             << must_solve << " of a kind that must be), " << no_room << " without room, " << left_out << " left out";
        if (holds + fails > 0) text << "; largest " << largest << " (world " << largest_of << ')';
        for (const auto& [what, seeds] : {std::pair{"failed", &failed}, {"not solved", &not_solved}}) {
            if (seeds->empty()) continue;
            text << "\n  " << what << ':';
            for (std::size_t k = 0; k < std::min<std::size_t>(seeds->size(), 40); ++k) text << ' ' << (*seeds)[k];
            if (seeds->size() > 40) text << " …";
        }
        return text.str();
    }
};

/// What is known of a property from runs before.
class Notes
{
public:
    Notes(const std::string& name, std::uint64_t first)
        : folder_(environment("TALUS_PROPERTIES_PROGRESS", "")),
          mark_(environment("TALUS_PROPERTIES_PROGRAM", "any") + ' ' + std::to_string(first))
    {
        if (!folder_.empty()) file_ = std::filesystem::path(folder_) / (name + ".progress");
    }

    Tally read() const
    {
        Tally tally;
        std::ifstream in(file_);
        std::string mark;
        if (file_.empty() || !std::getline(in, mark) || mark != mark_) return tally;
        tally.read(in);
        return in ? tally : Tally{};
    }

    void write(const Tally& tally) const
    {
        if (file_.empty()) return;
        const auto next = std::filesystem::path(file_.string() + ".new");
        {
            std::ofstream out(next);
            out << mark_ << '\n';
            tally.write(out);
        }
        std::filesystem::rename(next, file_); // so that a broken run leaves the notes whole
    }

private:
    std::string folder_, mark_;
    std::filesystem::path file_;
};

Verdict checked(const Check& check, std::uint64_t seed)
{
    try {
        return check(seed);
    } catch (const std::exception& error) {
        return {Verdict::Outcome::fails, std::string("threw: ") + error.what() + ", world " + std::to_string(seed)};
    }
}

} // namespace

void hold(const std::string& name, const Check& check, double share)
{
    omp_set_num_threads(1); // a second one brings nothing to so small worlds
    const double asked = std::stod(environment("TALUS_PROPERTIES_COUNT", "1000"));
    const auto count = static_cast<std::uint64_t>(std::ceil(share * asked));
    const std::uint64_t first = std::stoull(environment("TALUS_PROPERTIES_SEED", "1"));
    const Notes notes(name, first);
    Tally tally = notes.read();
    const std::size_t most_told = std::stoull(environment("TALUS_PROPERTIES_TELL", "3"));
    std::size_t told = 0;
    while (tally.looked_at < count) {
        const std::uint64_t seed = first + tally.looked_at;
        const Verdict verdict = checked(check, seed);
        tally.add(seed, verdict);
        if (verdict.outcome == Verdict::Outcome::fails && told++ < most_told) std::cout << verdict.why << std::endl;
        if (verdict.outcome == Verdict::Outcome::unsolved && told++ < most_told) std::cout << verdict.why << std::endl;
        if (tally.looked_at % noted_every == 0) notes.write(tally);
    }
    notes.write(tally);
    std::cout << name << ": " << tally.told() << std::endl;
    INFO(name << ": " << tally.told());
    CHECK(tally.fails == 0);
    CHECK(tally.must_solve == 0);
    CHECK(static_cast<double>(tally.unsolved) <=
          most_unsolved * static_cast<double>(tally.looked_at - tally.no_room - tally.left_out));
}

} // namespace talus::test
