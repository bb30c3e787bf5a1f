// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/schedule.hpp"

#include "core/base/vector.hpp"

#include <catch2/catch.hpp>

using talus::Schedule;

TEST_CASE("a schedule is met once in every interval, however the steps fall", "[app][schedule]")
{
    const double step = GENERATE(0.001, 0.0013, 0.003, 0.0099);
    CAPTURE(step);
    Schedule schedule(0.01);
    int met = 0;
    for (int k = 0; k * step < 10.0; ++k) {
        const double time = k * step;
        if (!schedule.due(time)) continue;
        const double due = 0.01 * met++;
        CHECK(time >= due - 1e-9);
        CHECK(time < due + step);
    }
    CHECK(met == 1000);
}

TEST_CASE("a schedule skips the times that a long step passes over", "[app][schedule]")
{
    Schedule schedule(0.01);
    CHECK(schedule.due(0.0));
    CHECK(schedule.due(0.035));
    CHECK_FALSE(schedule.due(0.038));
    CHECK(schedule.due(0.04));
}

TEST_CASE("an infinite interval is due at the start alone", "[app][schedule]")
{
    Schedule schedule(talus::infinity);
    CHECK(schedule.due(0.0));
    CHECK_FALSE(schedule.due(1e9));
}
