// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/mixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;

namespace
{

Materials glass_and_steel()
{
    Materials materials;
    materials.list = {{"glass", 2500.0}, {"steel", 7800.0}};
    return materials;
}

/// 30 % of the mass steel beads of 4 mm, 70 % glass beads of 5 to 9 mm.
Mixture two_species()
{
    return mixture_by_mass(
        {{1, {.min = 0.004, .max = 0.004}}, {0, {.min = 0.005, .max = 0.009}}}, {3.0, 7.0}, glass_and_steel());
}

double mass_of(const Grain& grain, const Materials& materials)
{
    return materials.list[static_cast<std::size_t>(grain.material)].density * std::numbers::pi / 6.0 *
           std::pow(grain.diameter, 3);
}

} // namespace

TEST_CASE("species come with their shares of the mass", "[mixture]")
{
    const auto mixture = two_species();
    const auto materials = glass_and_steel();
    Random random(1);
    constexpr int draws = 200000;
    double steel = 0.0, mass = 0.0, diameter = 0.0;
    for (int k = 0; k < draws; ++k) {
        const Grain grain = mixture.draw(random);
        mass += mass_of(grain, materials);
        diameter += grain.diameter;
        if (grain.material == 1) {
            CHECK(grain.diameter == 0.004);
            steel += mass_of(grain, materials);
        }
    }
    // About 0.4 of the spheres are steel: the share of the mass is uncertain by 0.1 %, the means by less.
    CHECK(steel / mass == Approx(0.3).margin(0.003));
    CHECK(mass / draws == Approx(mixture.mean_mass(materials)).epsilon(0.006));
    CHECK(diameter / draws == Approx(mixture.mean_diameter()).epsilon(0.003));
}

TEST_CASE("a mixture is as fine as its finest and as coarse as its coarsest species", "[mixture]")
{
    CHECK(two_species().min_diameter() == 0.004);
    CHECK(two_species().max_diameter() == 0.009);
}
