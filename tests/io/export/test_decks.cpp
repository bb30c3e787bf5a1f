// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/lammps_deck.hpp"
#include "io/export/liggghts_deck.hpp"
#include "io/scene/scene_file.hpp"
#include "scenarios/builder/build_scene.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

using namespace talus;
using Catch::Matchers::Contains;

namespace
{

/// A box with a gate in its floor that opens after 0.2 s, and two kinds of beads of two materials that are poured in.
const std::string poured = R"(
[time]
duration = 1.0
[materials.glass]
density = 2500.0
[materials.steel]
density = 7800.0
[[contact]]
between = ["glass", "glass"]
friction = 0.5
restitution = 0.5
[[contact]]
between = ["glass", "steel"]
friction = 0.3
[[contact]]
between = ["steel", "steel"]
friction = 0.2
[[pour]]
name = "rain"
count = 800
rate = 2000.0
velocity = [0, 0, -1]
region = { shape = "box", min = [-0.04, -0.04, 0.2], max = [0.04, 0.04, 0.25] }
[[pour.species]]
material = "glass"
diameter = { distribution = "uniform", min = 0.004, max = 0.006 }
share = 1
[[pour.species]]
material = "steel"
diameter = 0.005
share = 1
[[wall]]
name = "box"
shape = "box"
min = [-0.05, -0.05, 0]
max = [0.05, 0.05, 0.3]
open = ["z+", "z-"]
material = "steel"
[[wall]]
name = "gate"
shape = "disk"
radius = 0.08
material = "glass"
remove_at = 0.2
[[outlet]]
name = "below"
region = { shape = "box", min = [-0.2, -0.2, -0.2], max = [0.2, 0.2, -0.1] }
)";

/// One bead over a plane, with more keys.
std::string one_bead(const std::string& more)
{
    return R"(
[materials.glass]
[[contact]]
between = ["glass", "glass"]
[[fill]]
arrangement = "single"
position = [0, 0, 0.1]
velocity = [1, 2, 3]
diameter = 0.01
material = "glass"
[[wall]]
name = "floor"
shape = "plane"
material = "glass"
)" + more;
}

/// A scene with what was built of it.
struct Built {
    scene::Scene scene;
    Simulation simulation;

    explicit Built(const std::string& text)
        : scene(parse_scene(text)), simulation(std::move(build_scene(scene).simulation))
    {
    }
    Deck lammps() const { return lammps_deck(deck_basis(scene, simulation)); }
    Deck liggghts() const { return liggghts_deck(deck_basis(scene, simulation)); }
};

bool any_note(const Deck& deck, const std::string& part)
{
    return std::ranges::any_of(
        deck.notes, [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

/// Whether the parts stand in the text one after the other.
bool in_order(const std::string& text, const std::vector<std::string>& parts)
{
    std::size_t at = 0;
    for (const std::string& part : parts) {
        at = text.find(part, at);
        if (at == std::string::npos) return false;
    }
    return true;
}

} // namespace

TEST_CASE("the classes of a mixture have its number, its mass and its materials", "[export]")
{
    const Built built(poured);
    const Mixture& mixture = built.simulation.pours.front().mixture;
    double number = 0.0, volume = 0.0, glass = 0.0;
    for (const SizeClass& size : size_classes(mixture)) {
        number += size.share;
        volume += size.share * std::numbers::pi / 6.0 * std::pow(size.diameter, 3);
        if (size.material == 0) glass += size.share;
    }
    CHECK(number == Approx(1.0));
    // of 8000 draws, whose volumes vary by a third: their mean by 0.4 %
    CHECK(volume == Approx(mixture.mean_volume()).epsilon(0.015));
    CHECK(glass == Approx(mixture.species[0].number));
}

TEST_CASE("the data file has every sphere, and grains of walls as types of their own", "[export]")
{
    const Built built(
        one_bead("[[wall]]\nname = \"bed\"\nshape = \"grains\"\nmin = [-0.02, 0, 0.01]\nmax = [0.02, 0, 0.01]\n"
                 "diameter = 0.008\nmaterial = \"glass\"\n"));
    const DeckBasis basis = deck_basis(built.scene, built.simulation);
    const std::string text = data_file(basis);
    const auto grains = std::get<Grains>(built.simulation.model.walls[1].shape).centers.size();
    REQUIRE(grains > 2);
    CHECK_THAT(text, Contains(fmt::format("{} atoms", grains + 1)) && Contains("2 atom types"));
    CHECK_THAT(text, Contains("\n1 1 0.01 2500 0 0 0.1\n"));
    CHECK_THAT(text, Contains("\n1 1 2 3 0 0 0\n")); // its velocities
    CHECK_THAT(text, Contains("\n2 2 0.008 "));
    CHECK_THAT(text, Contains("\n2 0 0 0 0 0 0\n"));
    // only what moves is integrated
    CHECK_THAT(built.lammps().text, Contains("group grains1_glass type 1") && !Contains("type 2\nfix motion2"));
    CHECK_THAT(built.liggghts().text, Contains("neigh_modify exclude type 2 2"));
}

TEST_CASE("lists of neighbours last where a sphere reaches over many", "[export]")
{
    CHECK_THAT(Built(one_bead("")).lammps().text, Contains("\nneighbor 0.002 bin\n")); // a fifth of a diameter
    const Built ball(one_bead("[[fill]]\nmaterial = \"glass\"\ncount = 200\ndiameter = 0.001\n"
                              "region = { shape = \"box\", min = [-0.02, -0.02, 0], max = [0.02, 0.02, 0.02] }\n"));
    CHECK_THAT(ball.lammps().text, Contains("\nneighbor 0.001 bin\n")); // a tenth of the ball
    CHECK_THAT(ball.liggghts().text, Contains("\nneighbor 0.001 bin\n"));
}

TEST_CASE("a gate is there until its time in both decks", "[export]")
{
    const Built built(poured);
    const std::string lammps = built.lammps().text;
    CHECK(in_order(
        lammps, {"fix wall1_gate_1 grains1_glass wall/gran/region", "variable until equal ceil(0.2/${step})",
                    "run ${until} upto", "unfix wall1_gate_1", "variable until equal ceil(1/${step})", "run "}));
    const std::string liggghts = built.liggghts().text;
    CHECK(in_order(liggghts, {"fix wall1_gate all mesh/surface", "meshes wall0_box wall1_gate", "run ${until} upto",
                                 "unfix contacts", "unfix wall1_gate", "n_meshes 1 meshes wall0_box", "run "}));
}

TEST_CASE("each kind of sphere has its own law at a wall", "[export]")
{
    const std::string text = Built(poured).lammps().text;
    // the box is of steel: friction 0.3 to glass, 0.2 to steel
    CHECK_THAT(
        text, Contains("fix wall0_box_1 grains1_glass wall/gran/region granular hertz/material ${modulus} 0 0.25 "
                       "tangential mindlin NULL 1.0 0.3 damping tsuji region wall0_box"));
    CHECK_THAT(
        text, Contains("fix wall0_box_2 grains2_steel wall/gran/region granular hertz/material ${modulus} 0 0.25 "
                       "tangential mindlin NULL 1.0 0.2 damping tsuji region wall0_box"));
    CHECK_THAT(text, Contains("region wall0_box block -0.05 0.05 -0.05 0.05 0 0.3 open 6 open 5"));
    // restitutions by pair of types: glass-glass has 0.5, the others the least that LIGGGHTS takes
    CHECK_THAT(
        Built(poured).liggghts().text, Contains("coefficientRestitution peratomtypepair 2 0.5 0.051 0.051 0.051"));
}

TEST_CASE("pours of both decks let all spheres in", "[export]")
{
    const Built built(poured);
    const Deck liggghts = built.liggghts();
    CHECK_THAT(liggghts.text, Contains("nparticles 800 particlerate 2000") && Contains("vel constant 0 0 -1"));
    // in the group that is moved, which is one of the spheres that were there before
    CHECK_THAT(liggghts.text, Contains("fix pour0_rain_size0 grains1_glass particletemplate/sphere"));
    const std::string lammps = built.lammps().text;
    double count = 0.0;
    std::istringstream lines(lammps);
    for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find(" pour "); at != std::string::npos && line.starts_with("fix "))
            count += std::stod(line.substr(at + 6));
    CHECK(count == 800.0);
}

TEST_CASE("spheres in an outlet are taken out", "[export]")
{
    const Built built(poured);
    CHECK_THAT(built.lammps().text, Contains("region outlet0_below block -0.2 0.2 -0.2 0.2 -0.2 -0.1 units box") &&
                                        Contains("fix outlet0_below all evaporate ${look}"));
    CHECK_THAT(built.liggghts().text, Contains("every ${look} \"delete_atoms region outlet0_below compress no\""));
}

TEST_CASE("walls move in LAMMPS by formulas of time, in LIGGGHTS from one moment to another", "[export]")
{
    const Built built(one_bead(R"([[wall]]
name = "plate"
shape = "disk"
radius = 0.1
center = [0, 0, 0.2]
material = "glass"
[[wall.motion]]
kind = "turn"
axis = [0, 0, 1]
rate = -2.0
[[wall.motion]]
kind = "translate"
velocity = [0, 0, -0.5]
from = 0.1
to = 0.3
)"));
    const Deck lammps = built.lammps();
    CHECK_THAT(lammps.text, Contains("variable wall1_plate_z equal -0.5*((v_t>0.1)*(v_t-0.1)-(v_t>0.3)*(v_t-0.3))"));
    CHECK_THAT(lammps.text, Contains("variable wall1_plate_angle equal -2*((v_t>0)*(v_t-0))"));
    CHECK_THAT(lammps.text, Contains("move NULL NULL v_wall1_plate_z rotate v_wall1_plate_angle 0 0 0 0 0 1"));
    const Deck liggghts = built.liggghts();
    CHECK(in_order(
        liggghts.text, {"fix wall1_plate_move0 all move/mesh mesh wall1_plate rotate", "axis -0 -0 -1 period 3.14159",
                           "ceil(0.1/", "fix wall1_plate_move1 all move/mesh mesh wall1_plate linear 0 0 -0.5",
                           "ceil(0.3/", "unfix wall1_plate_move1"}));
}

TEST_CASE("what a deck cannot say is reported, and nothing is left out in silence", "[export]")
{
    const Built piston(one_bead("[[wall]]\nname = \"lid\"\nshape = \"disk\"\nradius = 0.1\ncenter = [0, 0, 0.3]\n"
                                "material = \"glass\"\nmass = 1\nguide = [0, 0, -1]\n[[sensor]]\nname = \"load\"\n"
                                "kind = \"wall_force\"\nwall = \"floor\"\n"));
    const Built tilted(one_bead("[[wall]]\nname = \"chute\"\nshape = \"cylinder\"\naxis = [1, 0, 1]\nradius = 0.1\n"
                                "height = 0.2\nmaterial = \"glass\"\n"));
    const Built swung(
        one_bead("[[wall]]\nname = \"arm\"\nshape = \"box\"\nmin = [1, 0, 0]\nmax = [2, 1, 1]\nopen = [\"z+\"]\n"
                 "material = \"glass\"\n[[wall.motion]]\nkind = \"translate\"\nvelocity = [1, 0, 0]\n"
                 "[[wall.motion]]\nkind = \"turn\"\naxis = [0, 0, 1]\nrate = 1\n"));
    for (const Deck& deck : {piston.lammps(), piston.liggghts()}) {
        CHECK(any_note(deck, "the wall 'lid' of finite mass stands still"));
        CHECK(any_note(deck, "the sensor 'load' of kind wall_force is left out"));
    }
    CHECK(any_note(tilted.lammps(), "the wall 'chute' is left out"));
    CHECK_FALSE(any_note(tilted.liggghts(), "chute"));
    CHECK(any_note(swung.lammps(), "the wall 'arm' stands still"));
    // the head has each note, perhaps broken into lines
    const Deck deck = tilted.lammps();
    const std::string head =
        deck_head(deck_basis(tilted.scene, tilted.simulation), {DeckProgram::lammps, "s", "0"}, deck.notes);
    CHECK_THAT(head, Contains("the wall 'chute' is left out"));
}
