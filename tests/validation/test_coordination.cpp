// SPDX-License-Identifier: GPL-3.0-or-later
// How many contacts a bead has in a bed at rest.
#include "run_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

/// Contacts of a bead that is no rattler, in the middle of the bed [1].
double coordination(const Simulation& simulation)
{
    return result(simulation, "middle", "coordination_without_rattlers").value;
}

} // namespace

TEST_CASE("beads compressed with friction have the coordination of other codes, and poured beads more",
    "[coordination][slow]")
{
    // Agnolin & Roux 2007 (Phys. Rev. E 76, 061302), isotropic compression with μ = 0.3 at low pressure: 4.5 contacts
    // without rattlers, packing fraction 0.593; Silbert 2010 (Soft Matter 6, 2918): 4.6 where the pressure vanishes.
    // Three seeds have 4.58 +- 0.01 here, and the overlap of a poured bed would add 0.1.
    auto compressed = open_scene("compressed");
    run_until(compressed, 2.6);
    const double z = coordination(compressed), packing = result(compressed, "middle", "packing_fraction").value;

    // Under gravity no bead is a rattler: with the tenth that are, three contacts each, 4.58 would be 4.7.
    auto poured = open_scene("compressed",
        {"world.gravity=[0, 0, -9.81]", "wall.lid.released_at=9", "time.duration=1", "sensor.middle.from=0.9"});
    run_until(poured, 1.0);
    const double z_poured = coordination(poured);

    WARN("coordination " << z << ", packing fraction " << packing << "; poured " << z_poured);
    CHECK(z == Approx(4.55).margin(0.1));
    CHECK(packing == Approx(0.593).epsilon(0.02));
    CHECK(z_poured - z > 0.2);
}
