// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/profile.hpp"
#include "core/sensors/region_share.hpp"
#include "tests/support/regions.hpp"
#include "tests/support/sampling.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double r = 0.005;

Region tube(double radius, double height)
{
    return cylinder(Vec3(0, 0, 0.02), Vec3::UnitZ(), radius, height);
}

/// The values of a column of the table.
std::vector<double> column(const Profile& profile, const std::string& name)
{
    const Table table = profile.table().value();
    std::vector<double> values;
    for (std::size_t k = 0; k < table.columns.size(); ++k)
        if (table.columns[k].name == name)
            for (const auto& row : table.rows) values.push_back(row[k]);
    REQUIRE(values.size() == table.rows.size());
    return values;
}

/// Spheres on a cubic lattice, n to each side of the axis and `layers` up from z = 0.
State lattice(int n, int layers, const std::function<Vec3(const Vec3&)>& velocity)
{
    State state;
    for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j)
            for (int k = 0; k < layers; ++k) {
                const Vec3 x = 2.0 * r * Vec3(i, j, k + 0.5);
                add_sphere(state, x, r, 2500.0, 0, velocity(x));
            }
    return state;
}

} // namespace

TEST_CASE("a uniform flow has the same packing and velocity in every bin", "[profile]")
{
    const Vec3 v(0.1, 0.0, -0.4);
    const State state = lattice(6, 12, [&](const Vec3&) { return v; });
    // Bins of one lattice period each: π/6 in all of them.
    Profile profile(
        "p", RegionBins(box(Vec3(-0.03, -0.03, 0.02), Vec3(0.03, 0.03, 0.1)), RegionBins::Direction::z, 8), {});
    for (int k = 0; k < 20; ++k) sample(profile, state, Model{});
    const auto position = column(profile, "position"), packing = column(profile, "packing_fraction");
    CHECK(position.front() == Approx(0.025));
    CHECK(position.back() == Approx(0.095));
    for (std::size_t bin = 0; bin < 8; ++bin) {
        CHECK(packing[bin] == Approx(std::numbers::pi / 6.0).margin(1e-3));
        CHECK(column(profile, "velocity_x")[bin] == Approx(0.1));
        CHECK(column(profile, "velocity_z")[bin] == Approx(-0.4));
        CHECK(column(profile, "velocity_z_error")[bin] == Approx(0.0).margin(1e-12));
        CHECK(column(profile, "granular_temperature")[bin] == Approx(0.0).margin(1e-12));
        CHECK(column(profile, "samples")[bin] == 20.0);
    }
    CHECK(profile.results()[0].value == Approx(std::numbers::pi / 6.0).margin(1e-3));
    CHECK(profile.results()[3].name == "velocity_z");
    CHECK(profile.results()[3].value == Approx(-0.4));
}

TEST_CASE("a shear flow is a straight line, and its bins hold no more temperature than their width", "[profile]")
{
    const State state = lattice(6, 12, [](const Vec3& x) { return Vec3(10.0 * x.z(), 0, 0); });
    Profile profile(
        "p", RegionBins(box(Vec3(-0.03, -0.03, 0), Vec3(0.03, 0.03, 0.12)), RegionBins::Direction::z, 12), {});
    sample(profile, state, Model{});
    for (std::size_t bin = 0; bin < 12; ++bin) {
        CHECK(column(profile, "velocity_x")[bin] == Approx(10.0 * (0.01 * static_cast<double>(bin) + 0.005)));
        CHECK(column(profile, "granular_temperature")[bin] == Approx(0.0).margin(1e-12));
    }
}

TEST_CASE("rings know radial, axial and azimuthal velocity", "[profile]")
{
    const State state =
        lattice(12, 6, [](const Vec3& x) { return Vec3(2.0 * x.x() - 5.0 * x.y(), 2.0 * x.y() + 5.0 * x.x(), -0.3); });
    Profile profile("p", RegionBins(tube(0.08, 0.02), RegionBins::Direction::radial, 8), {});
    sample(profile, state, Model{});
    const auto out = column(profile, "velocity_radial"), round = column(profile, "velocity_azimuthal");
    const auto packing = column(profile, "packing_fraction"), at = column(profile, "position");
    double solid = 0.0, volume = 0.0;
    for (std::size_t bin = 0; bin < 8; ++bin) {
        CHECK(column(profile, "velocity_axial")[bin] == Approx(-0.3));
        CHECK(round[bin] == Approx(2.5 * out[bin]));
        if (bin > 1) CHECK(out[bin] == Approx(2.0 * at[bin]).epsilon(0.06)); // centres lie unevenly in a ring
        const double ring = at[bin];
        solid += packing[bin] * ring;
        volume += ring;
    }
    CHECK(solid / volume == Approx(std::numbers::pi / 6.0).epsilon(0.02)); // a round cut through a square lattice
    CHECK(profile.results()[0].value == Approx(solid / volume));
}

TEST_CASE("the volumes of the bins add up to the region", "[profile]")
{
    using Direction = RegionBins::Direction;
    const Region cube = box(Vec3(1, 2, 3), Vec3(2, 4, 6)), round = tube(0.5, 2.0);
    const std::vector<std::pair<Region, Direction>> cuts = {{cube, Direction::x}, {cube, Direction::y},
        {cube, Direction::z}, {round, Direction::axial}, {round, Direction::radial}};
    for (const auto& [region, direction] : cuts) {
        const RegionBins bins(region, direction, 7);
        double sum = 0.0;
        for (std::size_t k = 0; k < bins.count(); ++k) sum += bins.volume(k);
        CHECK(sum == Approx(region.volume()));
    }
}

TEST_CASE("the temperature in a bin is about the mean over time", "[profile]")
{
    // One sphere at a time, with the velocities ±w in turn: ⟨v²⟩ = w², T = w²/3. A sample alone would know of none.
    State state = lattice(0, 1, [](const Vec3&) { return Vec3::Zero(); });
    Profile profile("p", RegionBins(box(Vec3::Constant(-0.1), Vec3::Constant(0.1)), RegionBins::Direction::x, 1), {});
    for (int k = 0; k < 10; ++k) {
        state.body(0).velocity.y() = k % 2 == 0 ? 0.6 : -0.6;
        sample(profile, state, Model{});
    }
    CHECK(column(profile, "granular_temperature")[0] == Approx(0.36 / 3.0));
    CHECK(column(profile, "velocity_y")[0] == Approx(0.0).margin(1e-15));
}

TEST_CASE("an empty bin has no velocity, and samples outside the window do not count", "[profile][degenerate]")
{
    State state = lattice(0, 1, [](const Vec3&) { return Vec3::UnitZ(); });
    Profile profile(
        "p", RegionBins(box(Vec3::Constant(-0.1), Vec3::Constant(0.1)), RegionBins::Direction::z, 10), {1.0, 2.0});
    sample(profile, state, Model{}); // at 0 s
    CHECK(std::isnan(profile.results()[0].value));
    state.time = 1.5;
    sample(profile, state, Model{});
    CHECK(column(profile, "samples") == std::vector<double>{0, 0, 0, 0, 0, 1, 0, 0, 0, 0});
    CHECK(std::isnan(column(profile, "velocity_z")[0]));
    CHECK(std::isnan(column(profile, "granular_temperature")[0]));
    CHECK(column(profile, "packing_fraction")[0] == 0.0);
}

TEST_CASE("a profile that was stored goes on as if nothing had been", "[profile][persist]")
{
    State state = lattice(1, 3, [](const Vec3& x) { return x; });
    const RegionBins bins(box(Vec3(-0.02, -0.02, 0), Vec3(0.02, 0.02, 0.02)), RegionBins::Direction::z, 2);
    Profile whole("a", bins, {}), first("a", bins, {}), second("a", bins, {});
    for (int k = 0; k < 50; ++k) {
        state.time = k;
        for (Body& m : state.bodies) m.velocity.z() = std::sin(k);
        sample(whole, state, Model{});
        sample(k < 21 ? first : second, state, Model{});
        if (k != 20) continue;
        Archive stored;
        first.persist(stored);
        Archive archive(stored.bytes());
        second.persist(archive);
        REQUIRE(archive.at_end());
    }
    CHECK(second.table()->rows == whole.table()->rows);
    CHECK(second.results()[3].spread == whole.results()[3].spread);
}
