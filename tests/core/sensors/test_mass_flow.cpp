// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/sensors/mass_flow.hpp"
#include "core/supply/removal.hpp"
#include "tests/support/sampling.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using talus::test::sample;

namespace
{

constexpr double radius = 0.005, density = 2500.0;

/// Spheres on the z axis that pass z = 0 downwards at given times: z = time of passage − t.
struct Stream {
    std::vector<double> passage;
    State state;

    explicit Stream(std::vector<double> times) : passage(std::move(times))
    {
        for (std::size_t i = 0; i < passage.size(); ++i) add_sphere(state, Vec3::Zero(), radius, density, 0);
    }

    void move_to(double time)
    {
        state.time = time;
        for (std::size_t i = 0; i < state.count(); ++i)
            state.position[i].z() = passage[static_cast<std::size_t>(state.id[i])] - time;
    }

    double mass() const { return state.mass(0); }
};

MassFlow downwards(double from, double to)
{
    return MassFlow("outlet", Vec3::Zero(), -Vec3::UnitZ(), {from, to});
}

void sample_until(MassFlow& sensor, Stream& stream, double end, double interval = 0.01)
{
    for (int k = 0; k * interval <= end; ++k) {
        stream.move_to(k * interval);
        sample(sensor, stream.state, Model{});
    }
}

/// `rate` spheres a second, evenly.
std::vector<double> even_passages(double rate, double start, double end)
{
    std::vector<double> times;
    for (int k = 0; k < rate * (end - start); ++k) times.push_back(start + (k + 0.5) / rate);
    return times;
}

/// `rate` spheres a second on average, each whenever it likes: a Poisson process.
std::vector<double> random_passages(double rate, double start, double end, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> times;
    for (double t = start; t < end; t -= std::log(1.0 - uniform(random)) / rate) times.push_back(t);
    return times;
}

/// Poisson flows of twice this rate or of none, by chance, each for so long.
std::vector<double> gusts(double rate, double length, double start, double end, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> times;
    for (double t = start; t < end; t += length)
        if (random() % 2 == 0)
            for (const double passage : random_passages(2.0 * rate, t, t + length, random())) times.push_back(passage);
    return times;
}

} // namespace

TEST_CASE("a constant flow is measured in mass and in spheres", "[mass_flow]")
{
    Stream stream(even_passages(1000.0, 0.0, 3.0));
    auto sensor = downwards(1.0, 2.0);
    sample_until(sensor, stream, 3.0);
    const auto results = sensor.results();
    CHECK(results[0].name == "mass_flow");
    CHECK(results[0].unit == "kg/s");
    CHECK(results[0].value == Approx(1000.0 * stream.mass()).epsilon(1e-3)); // one sphere in a window of a thousand
    CHECK(results[1].value == Approx(1000.0).epsilon(1e-3));
    CHECK(results[1].spread < 5.0);
}

TEST_CASE("only the steady window counts", "[mass_flow]")
{
    auto times = even_passages(5000.0, 0.0, 1.0);
    for (const double t : even_passages(1000.0, 1.0, 2.0)) times.push_back(t);
    Stream stream(times); // and nothing after 2 s
    auto sensor = downwards(1.05, 1.95);
    sample_until(sensor, stream, 3.0);
    CHECK(sensor.results()[1].value == Approx(1000.0).epsilon(2e-3));
}

TEST_CASE("the spread is as large as the error that noise makes", "[mass_flow]")
{
    // A Poisson flow of rate λ: over a time T the mean rate has a variance of λ/T. One that comes in gusts, with twice
    // the rate or none for a time τ each, has λ² τ/T more, and forgets within τ.
    constexpr double rate = 500.0, window = 8.0;
    const double gust = GENERATE(0.0, 0.1);
    const double expected = std::sqrt(rate / window + rate * rate * gust / window);
    double errors = 0.0, spreads = 0.0, independent = 0.0;
    int too_few = 0;
    constexpr int runs = 60;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        Stream stream(gust > 0.0 ? gusts(rate, gust, -1.0, 9.0, seed) : random_passages(rate, -1.0, 9.0, seed));
        auto sensor = downwards(0.5, 0.5 + window);
        sample_until(sensor, stream, 9.0);
        const auto flow = sensor.results()[1];
        errors += (flow.value - rate) * (flow.value - rate) / runs;
        spreads += flow.spread * flow.spread / runs;
        independent += *flow.independent / runs;
        too_few += flow.too_few;
    }
    CHECK(std::sqrt(errors) == Approx(expected).epsilon(0.3)); // of 60 numbers: 9 % of error, three times that
    CHECK(std::sqrt(spreads) == Approx(expected).epsilon(0.15));
    // Of 800 samples; from a dozen blocks of gusts it is by a fifth too large on average.
    CHECK(independent == Approx(gust > 0.0 ? 1.2 * window / gust : 800.0).epsilon(0.3));
    CHECK(too_few == 0);
}

TEST_CASE("a flow that goes on to fade in its window is said to be known too little", "[mass_flow]")
{
    auto times = even_passages(1000.0, 0.0, 1.0); // one at t comes at 2 t²: ever fewer
    for (double& t : times) t = 2.0 * t * t;
    Stream stream(times);
    auto sensor = downwards(0.05, 2.0);
    sample_until(sensor, stream, 2.0);
    CHECK(sensor.results()[1].too_few);
}

TEST_CASE("a sphere that left through an outlet has passed", "[mass_flow]")
{
    Stream stream(even_passages(100.0, 0.0, 1.0));
    auto sensor = downwards(0.0, infinity);
    stream.move_to(0.0);
    sample(sensor, stream.state, Model{});
    CHECK(sensor.latest()[1].value == 0.0);
    stream.move_to(0.5);
    sample(sensor, stream.state, Model{});
    CHECK(sensor.latest()[1].value == 50.0);
    CHECK(sensor.latest()[0].value == Approx(50.0 * stream.mass()));

    for (int i = 0; i < 40; ++i) stream.state.leaving[static_cast<std::size_t>(i)] = 1;
    Outflow outflow;
    ContactNetwork network;
    Model model;
    model.max_diameter = 2.0 * radius;
    empty_outlets(outflow, stream.state, network);
    stream.move_to(0.7);
    sample(sensor, stream.state, Model{});
    CHECK(sensor.latest()[1].value == 70.0);
    CHECK(sensor.latest()[0].value == Approx(70.0 * stream.mass()));
}

TEST_CASE("a sphere that is poured in behind the plane has not passed", "[mass_flow]")
{
    Stream stream(even_passages(100.0, 0.0, 1.0));
    auto sensor = downwards(0.0, infinity);
    stream.move_to(0.5);
    sample(sensor, stream.state, Model{});
    stream.passage.push_back(9.0);
    add_sphere(stream.state, Vec3::Zero(), radius, density, 0);
    stream.move_to(0.6);
    sample(sensor, stream.state, Model{});
    CHECK(sensor.latest()[1].value == 60.0);
}

TEST_CASE("without samples in the window the flow is not a number, and nothing has passed", "[mass_flow][degenerate]")
{
    auto sensor = downwards(1.0, 2.0);
    CHECK(sensor.latest()[0].value == 0.0);
    CHECK(std::isnan(sensor.results()[0].value));
    CHECK(std::isnan(sensor.results()[0].spread));
}

TEST_CASE("across a periodic axis a uniform flow is its mass times speed over the length of the cell",
    "[mass_flow][periodicity]")
{
    // Σ m v / L, though no sphere is ever behind the plane for good; against the flow it is negative.
    Model model;
    model.periodicity.length.x() = 0.2;
    model.time_step = 1e-3;
    State state;
    for (int i = 0; i < 7; ++i) add_sphere(state, Vec3(0.02 * i, 0, 0), radius, density, 0, Vec3(0.5, 3.0, 0));
    const double mass = 7 * state.mass(0);
    const auto flow_along = [&](const Vec3& normal) {
        MassFlow sensor("flow", Vec3(0.07, 0, 0), normal, {0.1, 0.9});
        const ContactNetwork no_network;
        const StepReport no_step;
        for (state.steps = 1; state.steps <= 1000; ++state.steps) {
            state.time = static_cast<double>(state.steps) * model.time_step;
            for (auto& x : state.position) x = model.periodicity.wrapped(x + model.time_step * Vec3(0.5, 3.0, 0));
            sensor.watch({state, model, no_network, no_step});
            if (state.steps % 5 == 0) sensor.sample({state, model, no_network, no_step});
        }
        CHECK(sensor.latest()[0].value == Approx(normal.x() * mass * 0.5 * 1.0 / 0.2));
        return sensor.results();
    };
    const auto forwards = flow_along(Vec3::UnitX()), backwards = flow_along(-Vec3::UnitX());
    CHECK(forwards[0].value == Approx(mass * 0.5 / 0.2));
    CHECK(forwards[1].value == Approx(7 * 0.5 / 0.2));
    CHECK(forwards[0].spread < 1e-9 * forwards[0].value);
    CHECK(backwards[0].value == Approx(-forwards[0].value));
}
