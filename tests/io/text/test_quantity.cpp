// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/quantity.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;

TEST_CASE("a number with a unit is brought to another one", "[quantity]")
{
    const auto in = [](const char* text, const char* unit) { return quantity_in(text, unit).value_or(-1.0); };
    CHECK(in("5 mm", "m") == Approx(0.005));
    CHECK(in("5e-3mm", "m") == Approx(5e-6));
    CHECK(in("+2.5 g/cm3", "kg/m3") == Approx(2500.0));
    CHECK(in("2.5 g / cm³", "kg/m3") == Approx(2500.0));
    CHECK(in("2.5 g cm^-3", "kg/m3") == Approx(2500.0));
    CHECK(in("72 mN/m", "J/m2") == Approx(0.072));
    CHECK(in("50 mJ/m2", "N/m") == Approx(0.05));
    CHECK(in("20 nl", "m3") == Approx(2e-11));
    CHECK(in("5 MPa", "N/m2") == Approx(5e6));
    CHECK(in("60 rpm", "rad/s") == Approx(2.0 * std::numbers::pi));
    CHECK(in("180 deg/s", "rad/s") == Approx(std::numbers::pi));
    CHECK(in("36 km/h", "m/s") == Approx(10.0));
    CHECK(in("3 kN/mm", "N/m") == Approx(3e6));
    CHECK(in("2 min", "s") == Approx(120.0));
    CHECK(in("3 1/min", "1/s") == Approx(0.05));
    CHECK(in("12 t/h", "kg/s") == Approx(12.0 / 3.6));
    CHECK(in("9.81 m/s²", "m/s2") == Approx(9.81));
    CHECK(in("9.81 N/kg", "m/s2") == Approx(9.81));
}

TEST_CASE("what is no quantity, or measures something else, is none", "[quantity]")
{
    for (const char* text : {"", "mm", "5", "5 m m/", "5 mmm", "5 /m", "five mm", "nan mm", "5 kg", "5 m2", "5 m/s"})
        CHECK_FALSE(quantity_in(text, "m"));
    CHECK_FALSE(quantity_in("5 Hz", "rad/s")); // turns or radians?
    CHECK_FALSE(quantity_in("300 rpm", "Hz"));
    CHECK_FALSE(quantity_in("5 m", "mean force"));
    CHECK_FALSE(quantity_in("5", ""));
    CHECK(is_quantity("5 kg/m3"));
    CHECK_FALSE(is_quantity("51"));
}
