// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

const std::string beads_in_a_box = R"(title = "Beads in a box"
[time]
duration = 0.05
frame_interval = 0.01
metrics_interval = 0.01
[materials.glass]
density = 2500.0
[[contact]]
between = ["glass", "glass"]
friction = 0.5
[[fill]]
material = "glass"
count = 8
diameter = 0.01
region = { shape = "box", min = [0, 0, 0], max = [0.05, 0.05, 0.05] }
[[wall]]
name = "tray"
shape = "box"
material = "glass"
min = [0, 0, 0]
max = [0.05, 0.05, 0.05]
open = ["z+"]
)";

const std::string bead_on_a_table = R"(title = "A bead falls off a table"
[time]
duration = 1.0
frame_interval = 0.05
[materials.glass]
density = 2500.0
[[contact]]
between = ["glass", "glass"]
friction = 0.1
[[fill]]
material = "glass"
count = 1
diameter = 0.01
region = { shape = "box", min = [-0.0051, -0.0051, 0.0], max = [0.0051, 0.0051, 0.0102] }
spacing = 1.02
velocity = [0.5, 0.0, 0.0]
[[wall]]
name = "table"
shape = "disk"
material = "glass"
center = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
radius = 0.03
)";

std::string stream_of_beads()
{
    const std::string longer = replaced(beads_in_a_box, "duration = 0.05", "duration = 0.4");
    return replaced(longer, "[\"z+\"]", "[\"z-\", \"z+\"]") + R"([[pour]]
name = "source"
material = "glass"
count = 20
rate = 100.0
diameter = { distribution = "uniform", min = 0.008, max = 0.01 }
region = { shape = "box", min = [0, 0, 0.05], max = [0.05, 0.05, 0.08] }
[[outlet]]
name = "drain"
region = { shape = "box", min = [-0.1, -0.1, -0.2], max = [0.15, 0.15, -0.05] }
[[sensor]]
name = "drain"
kind = "mass_flow"
point = [0, 0, -0.02]
from = 0.15
to = 0.3
)";
}

std::string loaded_beads()
{
    return replaced(beads_in_a_box, "duration = 0.05", "duration = 0.4") + R"([[wall]]
name = "plate"
shape = "box"
min = [0.001, 0.001, 0.06]
max = [0.049, 0.049, 0.07]
material = "glass"
mass = 0.5
guide = [0, 0, -1]
load = [[0.1, 0], [0.2, 20]]
released_at = 0.02
[[sensor]]
name = "plate"
kind = "wall_position"
wall = "plate"
from = 0.3
[[sensor]]
name = "on_plate"
kind = "wall_force"
wall = "plate"
from = 0.3
)";
}

Workplace::Workplace()
{
    std::string name = (fs::temp_directory_path() / "talus-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    folder_ = name;
}

Workplace::~Workplace()
{
    fs::remove_all(folder_);
}

void Workplace::write(const std::string& name, const std::string& text) const
{
    std::ofstream(path(name), std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const
{
    std::ifstream file(path(name));
    REQUIRE(file);
    return (std::ostringstream() << file.rdbuf()).str();
}

Outcome Workplace::talus(const std::string& arguments, const std::string& limits) const
{
    return shell(limits + " $TALUS " + arguments);
}

Outcome Workplace::shell(const std::string& commands) const
{
    const std::string command =
        "cd " + folder_.string() + " && TALUS=" TALUS_BINARY " && { " + commands + "; } > stdout.txt 2> stderr.txt";
    const int status = std::system(command.c_str());
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), read("stdout.txt"), read("stderr.txt")};
}

Outcome Workplace::talus_until(const std::string& file, const std::string& signal, const std::string& arguments) const
{
    return talus(
        arguments + " & pid=$!; until [ -e " + file + " ]; do sleep 0.005; done; kill -" + signal + " $pid; wait $pid");
}

Outcome Workplace::run(const std::string& scene, const std::string& options) const
{
    write("scene.toml", scene);
    return talus("run scene.toml -o out --threads 1 " + options);
}

std::string replaced(std::string text, const std::string& part, const std::string& replacement)
{
    const auto at = text.find(part);
    REQUIRE(at != std::string::npos);
    return text.replace(at, part.size(), replacement);
}

int line_of(const std::string& text, const std::string& part)
{
    const auto at = text.find(part);
    REQUIRE(at != std::string::npos);
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}
