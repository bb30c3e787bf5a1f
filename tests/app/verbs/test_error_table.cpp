// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"
#include "tests/app/readme_table.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <vector>

namespace
{

/// A situation in which the program complains: what a shell does first, and how `talus` is called. The folder holds
/// scene.toml (beads_in_a_box) and bead.toml (a bead that rolls off a table).
struct Situation {
    std::string text;
    std::string before; ///< shell commands; empty: none
    std::string arguments;
};

const std::string check = "check scene.toml";
const std::string run = "run scene.toml -o out --quiet --threads 1";
const std::string resume = "resume out --quiet --threads 1";

/// The scene with one part of a line replaced, as sed does it.
Situation edited(const std::string& text, const std::string& part, const std::string& replacement)
{
    return {text, "sed -i 's/" + part + "/" + replacement + "/' scene.toml", check};
}

Situation set(const std::string& text, const std::string& key_and_value)
{
    return {text, "", check + " --set '" + key_and_value + "'"};
}

/// The scene with another wall, of which only these keys are given.
Situation wall(const std::string& text, const std::string& keys)
{
    return {text, "printf '[[wall]]\\nname = \"w\"\\nmaterial = \"glass\"\\n" + keys + "\\n' >> scene.toml", check};
}

/// The same with a part of a motion.
Situation motion(const std::string& text, const std::string& keys)
{
    return wall(text, "shape = \"plane\"\n[[wall.motion]]\n" + keys);
}

/// The scene with another size of its spheres.
Situation size(const std::string& text, const std::string& diameter, const std::string& before = "")
{
    auto situation = edited(text, "diameter = 0.01", "diameter = " + diameter);
    situation.before = (before.empty() ? "" : before + "; ") + situation.before;
    return situation;
}

/// The scene with a fill from a file, of which only these keys are given.
Situation file_fill(const std::string& text, const std::string& before, const std::string& keys = "file = \"s.csv\"")
{
    return {text,
        before + "; printf '[[fill]]\narrangement = \"file\"\nmaterial = \"glass\"\n" + keys + "\n' >> scene.toml",
        check};
}

/// The scene with a pour, of which these keys are given besides material, size and region.
Situation pour(const std::string& text, const std::string& keys)
{
    return {text,
        "printf '[[pour]]\nmaterial = \"glass\"\ndiameter = 0.01\nregion = { max = [0.05, 0.05, 0.05] }\n" + keys +
            "\n' >> scene.toml",
        check};
}

/// The scene with a mesh of one facet.
Situation stl(const std::string& text, const std::string& corners)
{
    return {text,
        "printf 'solid\\nfacet normal 0 0 0 outer loop " + corners +
            " endloop endfacet\\nendsolid\\n' > cup.stl; printf '[[wall]]\\nname = \"w\"\\nmaterial = \"glass\"\\nmesh "
            "= "
            "\"cup.stl\"\\n' >> scene.toml",
        check};
}

/// A contact problem of others. @param before "{}" stands for its file
Situation problem(const std::string& text, std::string before, const std::string& arguments)
{
    return {text, before.replace(before.find("{}"), 2, TALUS_SOURCE_DIR "/tests/data/fclib/local_problem_test.hdf5"),
        arguments};
}

Situation sensor(const std::string& text, const std::string& keys)
{
    return {text, "printf '[[sensor]]\\nname = \"s\"\\n" + keys + "\\n' >> scene.toml", check};
}

/// After a run of the scene, and what else a shell does to its folder.
Situation after_run(const std::string& text, const std::string& before, const std::string& arguments)
{
    return {text, std::string(TALUS_BINARY) + " " + run + (before.empty() ? "" : "; " + before), arguments};
}

/// A run that gets a signal when it has begun.
std::string stopped_by(const std::string& signal)
{
    return run + " --until 9 & pid=$!; until [ -e out/frames/particles_000002.vtp ]; do sleep 0.005; done; kill -" +
           signal + " $pid; wait $pid";
}

/// The rows of the table. A new message is a new line here; TALUS_UPDATE_TABLES=1 then writes the table.
const std::vector<Situation> situations = {
    {"no verb", "", ""},
    {"an unknown verb", "", "fly"},
    {"no scene named", "", "run"},
    {"an unknown option", "", "run scene.toml --fast"},
    {"a wrong number of threads", "", "run scene.toml --threads 0"},
    {"an end before the beginning", "", "run scene.toml --until -1"},
    {"a seed that is too large", "", "run scene.toml --seed 9223372036854775808"},
    {"a folder without a name", "", "run scene.toml -o ''"},
    {"a step after the end", "", "dump scene.toml --at 0.06 -o step.hdf5"},
    {"a periodic axis given twice", "", check + " --set 'world.periodic=[\"x\", \"x\"]'"},
    {"two options that exclude each other", "", "run scene.toml --quiet --verbose"},
    {"a case with a setting of its own", "", "run out --case 1 --seed 2"},
    {"a case of what is no sweep", "mkdir out", "run out --case 1"},
    {"a scene that is not there", "", "run nowhere"},
    {"keys of a table that is not there", "", "keys wal"},
    edited("text that is not TOML", "count = 8", "count = = 8"),
    {"a scene file that is too large", "head -c 2000000 /dev/zero > scene.toml", check},
    edited("a misspelt key", "friction", "fricton"),
    edited("a misspelt table", "\\[time\\]", "[tine]"),
    edited("a wrong type", "duration = 0.05", "duration = \"long\""),
    edited("a value out of range", "density = 2500.0", "density = -1.0"),
    edited("a value that is not a number", "density = 2500.0", "density = nan"),
    edited("a name that would paint the terminal", "name = \"tray\"", "name = \"\\\\u001b[31mtray\""),
    edited("a number beyond all sense", "density = 2500.0", "density = 1e300"),
    edited("a number too small for anything", "diameter = 0.01", "diameter = 1e-200"),
    edited("a number with the unit of another", "diameter = 0.01", "diameter = \"10 kg\""),
    edited("a whole number is wanted", "count = 8", "count = 8.5"),
    edited("a vector is wanted", "min = \\[0, 0, 0\\]", "min = [0, 0]"),
    edited("a name that is not allowed", "^shape = \"box\"", "shape = \"bowl\""),
    edited("a key of another shape", "^open", "hole_radius = 0.01\\nopen"),
    edited("a missing key", "name = \"tray\"", ""),
    set("--set without a value", "time.duration"),
    set("--set of a misspelt key", "time.duraton=1"),
    set("--set of a value that is not TOML", "time.duration=[1"),
    set("--set in a table that is not there", "wall.gate.remove_at=1"),
    set("--set of a whole table", "wall.tray=1"),
    set("--set within a value", "time.duration.long=1"),
    set("a step longer than the run", "time.step=100"),
    edited("an unknown material", "material = \"glass\"", "material = \"steel\""),
    edited("a contact of one material", "\\[\"glass\", \"glass\"\\]", "[\"glass\"]"),
    {"a contact given twice", "printf '[[contact]]\\nbetween = [\"glass\", \"glass\"]\\n' >> scene.toml", check},
    {"a contact not given", "sed -i 's/^material = \"glass\"/material = \"wood\"/; $ a [materials.wood]' scene.toml",
        check},
    {"a stiffness of rigid contacts", "",
        check + " --set solver.stabilisation=projected --set contact.0.stiffness=1e5"},
    set("fewer sweeps at most than at least", "solver.max_sweeps=1"),
    set("no automatic step", "world.gravity=[0, 0, 0]"),
    {"an empty world", "", check + " --set 'world.min=[1, 1, 1]' --set 'world.max=[1, 1, 1]'"},
    set("no spheres", "fill.0.count=0"),
    edited("a fill region too small for its spheres", "count = 8", "count = 800"),
    edited("a fill region smaller than a sphere", "max = \\[0.05, 0.05, 0.05\\] }", "max = [0.05, 0.05, 0.001] }"),
    edited("an empty fill region", "max = \\[0.05, 0.05, 0.05\\] }", "max = [0.05, 0.05, -0.05] }"),
    set("a fill region outside of the world", "world.max=[0.04, 1, 1]"),
    edited("diameters upside down", "diameter = 0.01",
        "diameter = { distribution = \"uniform\", min = 0.02, max = 0.01 }"),
    wall("two walls of one name", "shape = \"plane\"\\n[[wall]]\\nname = \"w\"\\nmaterial = \"glass\""
                                  "\\nshape = \"plane\""),
    wall("a wall without direction", "shape = \"plane\"\\nnormal = [0, 0, 0]"),
    wall("a disk without radius", "shape = \"disk\"\\nradius = 0"),
    wall("a hole larger than its disk", "shape = \"disk\"\\nradius = 0.01\\nhole_radius = 0.02"),
    wall("an empty box", "shape = \"box\"\\nmax = [0, 1, 1]"),
    wall("a mesh that is not there", "mesh = \"cup.stl\""),
    {"a mesh that is no STL",
        "echo 'a letter to a friend' > cup.stl; printf '[[wall]]\\nname = \"w\"\\n"
        "material = \"glass\"\\nmesh = \"cup.stl\"\\n' >> scene.toml",
        check},
    stl("a mesh of lines", "vertex 0 0 0 vertex 1 0 0 vertex 2 0 0"),
    stl("a mesh with a corner beyond all sense", "vertex 0 0 0 vertex 1 0 0 vertex 0 0 1e300"),
    {"a mesh that ends too early",
        "printf 'solid cup\\nfacet normal 0 0 1\\nouter loop\\nvertex 0 0' > cup.stl; printf "
        "'[[wall]]\\nname = \"w\"\\nmaterial = \"glass\"\\nmesh = \"cup.stl\"\\n' >> scene.toml",
        check},
    sensor("a sensor that measures backwards", "kind = \"mass_flow\"\\nfrom = 1\\nto = 1"),
    sensor("a sensor whose line has no length", "kind = \"repose\"\\ninner_radius = 1\\nouter_radius = 1"),
    sensor("a region of no size", "kind = \"region\"\nregion = { max = [0, 0, 0] }"),
    sensor("an unknown wall", "kind = \"wall_force\"\nwall = \"lid\""),
    sensor("a profile across a box of a cylinder's direction",
        "kind = \"profile\"\ndirection = \"radial\"\nregion = { max = [1, 1, 1] }"),
    sensor("a slope without direction", "kind = \"slope\"\nalong = [0, 0, 0]\nlength = 1"),
    edited("an array that frames do not have", "^\\[time\\]", "[output]\\nparticle_arrays = [\"colour\"]\\n[time]"),
    motion("an unknown motion", "kind = \"fly\""),
    motion("a motion without its velocity", "kind = \"translate\""),
    motion("a motion that ends before it begins", "kind = \"translate\"\nvelocity = [1, 0, 0]\nfrom = 2\nto = 1"),
    motion("a turn about no axis", "kind = \"turn\"\naxis = [0, 0, 0]\nrate = 1"),
    motion("a key of another motion", "kind = \"turn\"\naxis = [0, 0, 1]\nrate = 1\nfrequency = 2"),
    motion("a table of no rows", "kind = \"table\"\ntable = []"),
    motion("a table with a short row", "kind = \"table\"\ntable = [[0, 0, 0]]"),
    motion("a table that goes back in time", "kind = \"table\"\ntable = [[1, 0, 0, 0], [0, 0, 0, 0]]"),
    wall("a mass without a guide", "shape = \"disk\"\nradius = 1\nmass = 1"),
    wall("a mass and a motion", "shape = \"disk\"\nradius = 1\nmass = 1\nguide = [0, 0, 1]\n[[wall.motion]]\n"
                                "kind = \"translate\"\nvelocity = [1, 0, 0]"),
    wall("a mass that is taken away", "shape = \"disk\"\nradius = 1\nmass = 1\nguide = [0, 0, 1]\nremove_at = 1"),
    wall("a plane of finite mass", "shape = \"plane\"\nmass = 1\nguide = [0, 0, 1]"),
    wall("a load without a mass", "shape = \"disk\"\nradius = 1\nload = 1"),
    wall("a load that is no number", "shape = \"disk\"\nload = [1, 2]"),
    wall("a load that goes back in time",
        "shape = \"disk\"\nradius = 1\nmass = 1\nguide = [0, 0, 1]\nload = [[1, 0], [0, 1]]"),
    sensor("the position of a wall without mass", "kind = \"wall_position\"\nwall = \"tray\""),
    {"a guide along a periodic axis",
        "printf '[[wall]]\nname = \"w\"\nmaterial = \"glass\"\nshape = \"disk\"\nradius = 1\nmass = 1\n"
        "guide = [1, 0, 0]\n' >> scene.toml",
        check + " --set 'world.periodic=[\"x\"]' --set 'world.min=[0,-inf,-inf]' --set 'world.max=[1,inf,inf]'"},
    wall("grains in a box upside down", "shape = \"grains\"\nmin = [0, 0, 1]\nmax = [1, 1, 0]\ndiameter = 0.01"),
    wall("grains beyond number", "shape = \"grains\"\nmax = [1, 1, 0]\ndiameter = 1e-9"),
    set("an unknown periodic axis", "world.periodic=[\"w\"]"),
    set("a periodic axis without ends", "world.periodic=[\"x\"]"),
    {"a periodic axis that is too short", "",
        check + " --set 'world.periodic=[\"x\"]' --set 'world.min=[0,-inf,-inf]' --set 'world.max=[0.02,inf,inf]'"},
    {"a plane across a periodic axis",
        "printf '[[wall]]\nname = \"w\"\nmaterial = \"glass\"\nshape = \"plane\"\n' >> scene.toml",
        check + " --set 'world.periodic=[\"z\"]' --set 'world.min=[-inf,-inf,0]' --set 'world.max=[inf,inf,1]'"},
    {"rolling resistance without rotation", "",
        check + " --set world.rotation=false --set contact.0.rolling_friction=0.1"},
    set("an unknown law of cohesion", "contact.0.cohesion.law=\"glue\""),
    set("cohesion without what its law needs", "contact.0.cohesion.law=\"liquid\""),
    {"a negative work of adhesion", "",
        check + " --set contact.0.cohesion.law=dmt --set contact.0.cohesion.work_of_adhesion=-1"},
    {"a key of another law of cohesion", "",
        check + " --set contact.0.cohesion.law=dmt --set contact.0.cohesion.work_of_adhesion=1 --set "
                "contact.0.cohesion.volume=1e-9"},
    {"cohesion over half a diameter", "",
        check + " --set contact.0.cohesion.law=constant --set 'contact.0.cohesion.force=\"1 mN\"' --set "
                "contact.0.cohesion.range=0.1"},
    set("neither true nor false", "world.rotation=1"),
    size("a normal distribution cut to nothing",
        "{ distribution = \"normal\", mean = 0.01, deviation = 0.001, min = 0.05, max = 0.06 }"),
    size("a sieve without a file", "{ distribution = \"sieve\" }"),
    size("a sieve file that is not there", "{ distribution = \"sieve\", file = \"s.csv\" }"),
    size("a sieve file with a wrong header", "{ distribution = \"sieve\", file = \"s.csv\" }",
        "printf 'a,b\n1,2\n' > s.csv"),
    size("a sieve file that falls", "{ distribution = \"sieve\", file = \"s.csv\" }",
        "printf 'size_mm,passing_percent\n5,0\n6,50\n7,40\n' > s.csv"),
    edited("species and a material", "count = 8",
        "count = 8\\nspecies = [{ material = \"glass\", diameter = 0.01, share = 1 }]"),
    file_fill("a file of spheres that is not there", "true"),
    file_fill("a file of spheres with a column missing", "printf 'x,y,radius\n1,2,3\n' > s.csv"),
    file_fill("a file of spheres with a word for a number", "printf 'x,y,z,radius\n1,2,three,4\n' > s.csv"),
    file_fill("a file of spheres that no one can read", "echo notes > s.vtp", "file = \"s.vtp\""),
    file_fill("a file of spheres of another kind", "echo notes > s.txt", "file = \"s.txt\""),
    pour("a pour of nothing", "rate = 10"),
    pour("a pour by number and by mass", "count = 10\nmass = 1\nrate = 10"),
    pour("a pour without a rate", "count = 10"),
    {"a new scene in place of another", "", "new scene"},
    {"a new scene from one that does not come with Talus", "", "new mine --from scene.toml"},
    {"a new scene in a folder that is not there", "", "new nowhere/mine"},
    {"a folder with other files", "mkdir out; touch out/thesis.tex", run},
    {"a folder that is a file", "touch out", run},
    after_run("a folder that holds a run", "", run),
    {"resume without a folder", "", resume},
    {"resume of a folder without a run", "mkdir out; touch out/thesis.tex", resume},
    after_run("resume without a checkpoint", "rm out/checkpoint.*", resume),
    after_run("resume with a broken checkpoint", "truncate -s -1 out/checkpoint.latest", resume),
    after_run("resume with a file that is no checkpoint", "echo notes > out/checkpoint.latest", resume),
    after_run("resume with a checkpoint of another Talus", "sed -i 's/0\\.1\\.0/0.0.9/' out/checkpoint.latest", resume),
    after_run("resume with another physics", "", resume + " --set contact.glass-glass.friction=0.1"),
    after_run("resume to a time that is over", "", resume + " --until 0.01"),
    after_run("resume without its metrics", "rm out/metrics.csv", resume),
    after_run("resume with metrics that were cut", "truncate -s 100 out/metrics.csv", resume),
    {"resume with another mesh",
        "printf 'solid\\nfacet normal 0 0 1\\nouter loop\\nvertex 0 0 -1\\nvertex 1 0 -1\\nvertex 0 1 -1\\nendloop\\n"
        "endfacet\\nendsolid\\n' > cup.stl; printf '[[wall]]\\nname = \"w\"\\nmaterial = \"glass\"\\nmesh = \"cup.stl\""
        "\\n' >> scene.toml; " TALUS_BINARY " run scene.toml -o out --quiet; sed -i s/-1/-2/ out/files/cup.stl",
        resume},
    {"a sphere that escapes", "", "run bead.toml --quiet"},
    {"a sphere that is too fast", "",
        "run bead.toml --quiet --until 9 --set 'world.gravity=[9.81, 0, 0]' --set 'world.periodic=[\"x\"]' "
        "--set 'world.min=[-1, -inf, -inf]' --set 'world.max=[1, inf, inf]'"},
    {"a wall of finite mass that escapes",
        "printf '[[wall]]\nname = \"w\"\nmaterial = \"glass\"\nshape = \"disk\"\ncenter = [1, 1, 0]\nradius = 0.1"
        "\nmass = 1\nguide = [0, 0, 1]\n' >> scene.toml",
        run + " --until 1"},
    {"a press that closes on a rigid sphere",
        "printf '[[wall]]\nname = \"lid\"\nmaterial = \"glass\"\nshape = \"disk\"\ncenter = [0, 0, 0.0105]\nradius = "
        "0.03"
        "\n[[wall.motion]]\nkind = \"translate\"\nvelocity = [0, 0, -0.01]\n' >> bead.toml",
        "run bead.toml --quiet --until 1 --set solver.stabilisation=projected --set 'fill.0.velocity=[0, 0, 0]'"},
    {"SIGINT", "", stopped_by("INT")},
    {"SIGTERM", "", stopped_by("TERM")},
    {"a folder into which another writes",
        "mkdir out; echo process 1 on farm > out/talus.lock; exec 9< out/talus.lock; flock 9", run},
    {"a folder that cannot be made", "touch file", "run scene.toml -o file/out"},
    {"a log file that cannot be written", "", run + " --log-file nowhere/log"},
    {"a name that is too long", "name=$(printf 'a%.0s' $(seq 300))", "check $name"},
    {"an output folder whose name is too long", "name=$(printf 'a%.0s' $(seq 300))", "run scene.toml --quiet -o $name"},
    {"a dump to a name that is too long", "name=$(printf 'a%.0s' $(seq 300))", "dump scene.toml --at 0.01 -o $name"},
    {"more threads than memory allows", "ulimit -v 1500000", "run scene.toml -o out --quiet --threads 1000"},
    {"a limit on the size of files, by its signal", "ulimit -f 16", run + " --set time.metrics_interval=1e-4"},
    {"a disk that is full", "trap \"\" XFSZ; ulimit -f 16", run + " --set time.metrics_interval=1e-4"},
    {"a log file that is a scene", "", run + " --log-file scene.toml"},
    {"a dump in place of a scene", "", "dump scene.toml --at 0.02 -o scene.toml"},
    {"a dump without a time", "", "dump scene.toml -o step.hdf5"},
    {"a dump into a folder that is not there", "", "dump scene.toml --at 0.02 -o nowhere/step.hdf5 --quiet"},
    {"an export without a format", "", "export scene.toml"},
    {"a format that is not known", "", "export scene.toml --format stl"},
    {"an export of no run", "mkdir out", "export out --format csv"},
    after_run("an export of a run without frames", "rm out/particles.pvd", "export out --format csv"),
    after_run("a frame that was cut", "truncate -s 100 out/frames/particles_000001.vtp", "export out --format csv"),
    after_run(
        "an export where something else is", "mkdir there; touch there/thesis.tex", "export out --format csv -o there"),
    after_run("an export where one is", "$TALUS export out --format csv -o there --quiet 2> notes",
        "export out --format csv -o there"),
    after_run("a change to a run that is over", "", "export out --format csv --until 2"),
    {"a problem that is not there", "", "solve nowhere.hdf5"},
    {"a problem that is no HDF5 file", "", "solve scene.toml"},
    problem("a problem that was cut", "head -c 20000 {} > p.hdf5", "solve p.hdf5"),
    problem("an algorithm for equalities", "cp {} p.hdf5", "solve p.hdf5 --algorithm 2.1 --quiet"),
    problem("a guess that is not there", "cp {} p.hdf5", "solve p.hdf5 --guess 7 --quiet"),
    problem("an unknown local solve", "cp {} p.hdf5", "solve p.hdf5 --local newton"),
    problem("a relaxation out of range", "cp {} p.hdf5", "solve p.hdf5 --omega 2"),
    problem("a result in place of the problem", "cp {} p.hdf5", "solve p.hdf5 -o p.hdf5"),
    problem("a seed of an order that is not shuffled", "cp {} p.hdf5", "solve p.hdf5 --seed 3"),
    problem("a tolerance that is not met", "cp {} p.hdf5", "solve p.hdf5 --max-sweeps 3 --quiet"),
};

std::string in_table(std::string text, const Workplace& place)
{
    const std::string folder = place.path("").string();
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.replace(at, folder.size(), "/…/");
    return table_cell(
        as_shown(text, {{"neither a file nor one of .*", "neither a file nor one of …"},
                           {"none of those that come with Talus: .*", "none of those that come with Talus: …"},
                           {"a{300}", "a…"}, {"gives this process [0-9]*:", "gives this process …:"},
                           {R"(is at \(.*\) m with .* m/s)", "is at (…) m with … m/s"},
                           {R"(by [^ ]* m at \([^)]*\) m)", "by … m at (…) m"}}));
}

/// A row of the table, checked for what every complaint must be: one line, on standard error, with an exit code.
std::string row(const Situation& situation)
{
    INFO(situation.text);
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    place.write("bead.toml", bead_on_a_table);
    const std::string before = situation.before.empty() ? "" : situation.before + ";";
    const Outcome outcome = place.talus(situation.arguments, before);
    CHECK(outcome.exit_code != 0);
    CHECK(outcome.out.empty());
    CHECK(line_of(outcome.err + "|", "|") == 2);
    return fmt::format("| {} | {} | `{}` |\n", situation.text, outcome.exit_code, in_table(outcome.err, place));
}

} // namespace

TEST_CASE("every complaint is one sentence with an exit code, as the table in tests/results/errors.md has it",
    "[app][errors][not under thread]")
{
    std::string table = "| situation | exit code | sentence |\n| --- | --- | --- |\n";
    for (const Situation& situation : situations) table += row(situation);

    check_readme_table("errors", table);
}
