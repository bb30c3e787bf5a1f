// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/frames.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

TEST_CASE("the .pvd lists every frame with its time and relative file", "[frames]")
{
    const SceneFolder folder;
    Simulation simulation;
    FrameWriter frames(folder.path());
    frames.write_particles(simulation);
    simulation.state.time = 0.1;
    frames.write_particles(simulation);
    CHECK(read_file(folder.path() / "particles.pvd") ==
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n"
          "    <DataSet timestep=\"0\" part=\"0\" file=\"frames/particles_000000.vtp\"/>\n"
          "    <DataSet timestep=\"0.1\" part=\"0\" file=\"frames/particles_000001.vtp\"/>\n"
          "  </Collection>\n</VTKFile>\n");
}

TEST_CASE("a resumed run takes away the frames after its checkpoint", "[frames]")
{
    const SceneFolder folder;
    const Simulation simulation;
    FrameWriter frames(folder.path());
    frames.write_particles(simulation);
    Archive stored;
    stored(frames);
    const std::string list = read_file(folder.path() / "particles.pvd");
    for (int k = 0; k < 3; ++k) frames.write_particles(simulation);
    frames.write_walls(Model(), State());

    FrameWriter resumed(folder.path());
    Archive(stored.bytes())(resumed);
    resumed.cut_back();
    CHECK(read_file(folder.path() / "particles.pvd") == list);
    CHECK(std::filesystem::exists(folder.path() / "frames/particles_000000.vtp"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "frames/particles_000001.vtp"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "frames/particles_000003.vtp"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "walls.pvd"));
}

TEST_CASE("a frame that the disk does not take is an output error and leaves no half file", "[frames]")
{
    const SceneFolder folder;
    FrameWriter frames(folder.path());
    std::filesystem::create_symlink("/dev/full", folder.path() / "frames/particles_000000.vtp.tmp");
    CHECK(folder.without_folder(error_of<OutputError>([&] { frames.write_particles(Simulation()); })) ==
          "frames/particles_000000.vtp: cannot be written: No space left on device");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "frames/particles_000000.vtp"));
    CHECK_FALSE(std::filesystem::exists(folder.path() / "particles.pvd"));
    const auto file = folder.write("file", "");
    CHECK(folder.without_folder(error_of<OutputError>([&] { FrameWriter writer(file); })) ==
          "file/frames: cannot be made: Not a directory");
}
