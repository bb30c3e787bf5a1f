// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/frames.hpp"
#include "io/scene/sphere_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>

#include <fcntl.h>
#include <unistd.h>

using namespace talus;
using namespace talus::test;

namespace
{

/// The point data of a .vtu file of two points.
const std::string radii = "<DataArray Name='radius' type='Float32' format='ascii'>0.5 0.25</DataArray>";

/// A .vtu file; of two points unless `positions` says otherwise.
std::string vtu(const std::string& point_data, const std::string& positions = "0 0 1  2 0 1", int points = 2)
{
    return "<?xml version='1.0'?>\n<VTKFile type='UnstructuredGrid' version='0.1' byte_order='LittleEndian'>\n"
           "<UnstructuredGrid><Piece NumberOfPoints='" +
           std::to_string(points) +
           "' NumberOfCells='0'>\n<Points><DataArray type='Float64' NumberOfComponents='3' format='ascii'>" +
           positions +
           "</DataArray></Points>\n<Cells><DataArray type='Int64' Name='connectivity' format='ascii'/>"
           "<DataArray type='Int64' Name='offsets' format='ascii'/>"
           "<DataArray type='UInt8' Name='types' format='ascii'/></Cells>\n<PointData>" +
           point_data + "</PointData></Piece></UnstructuredGrid></VTKFile>\n";
}

std::string refusal_of(const std::string& name, const std::string& bytes)
{
    const SceneFolder folder;
    const auto path = folder.write(name, bytes);
    return folder.without_folder(error_of<InputError>([&] { read_spheres(path); }));
}

scene::SphereList spheres_of(const std::string& name, const std::string& bytes)
{
    const SceneFolder folder;
    return read_spheres(folder.write(name, bytes));
}

/// What the process prints as errors, whatever the way, as long as this lives.
class ErrorStream
{
public:
    ErrorStream() : file_(folder_.write("stderr", "")), usual_(::dup(2))
    {
        const int to_file = ::open(file_.c_str(), O_WRONLY | O_APPEND);
        ::dup2(to_file, 2);
        ::close(to_file);
    }
    ~ErrorStream()
    {
        ::dup2(usual_, 2);
        ::close(usual_);
    }
    ErrorStream(const ErrorStream&) = delete;
    ErrorStream& operator=(const ErrorStream&) = delete;

    std::string printed() const
    {
        std::fflush(stderr);
        return read_file(file_);
    }

private:
    SceneFolder folder_;
    std::filesystem::path file_;
    int usual_;
};

} // namespace

TEST_CASE("a frame of the program reads back to the same spheres, to the precision of floats", "[sphere_file]")
{
    Simulation simulation;
    State& state = simulation.state;
    Random random(1);
    const auto number = [&] { return 2.0 * uniform(random) - 1.0; };
    for (int i = 0; i < 100; ++i)
        add_sphere(state, Vec3(number(), number(), number()), 0.01 * (1.5 + number()), 2500.0, 0,
            Vec3(number(), number(), number()), Vec3(number(), number(), number()));
    const SceneFolder folder;
    FrameWriter(folder.path()).write_particles(simulation);
    const auto spheres = read_spheres(folder.path() / "frames/particles_000000.vtp");
    REQUIRE(spheres.positions.size() == 100);
    constexpr double float_precision = std::numeric_limits<float>::epsilon();
    for (std::size_t i = 0; i < 100; ++i) {
        CHECK((spheres.positions[i] - state.position[i]).norm() < float_precision);
        CHECK((spheres.velocities.at(i) - state.body(i).velocity).norm() < float_precision);
        CHECK(spheres.radii.at(i) == Approx(state.radius[i]).epsilon(float_precision));
        const Vec3 rim = spheres.radii[i] * spheres.angular_velocities.at(i);
        CHECK((rim - state.body(i).rim_velocity).norm() < float_precision);
    }
}

TEST_CASE("a .vtu file gives its spheres, whatever the capitals of its arrays", "[sphere_file]")
{
    const auto data = GENERATE_COPY(as<std::string>{}, radii,
        "<DataArray Name='Radius' type='Float64' format='ascii'>0.5 0.25</DataArray>",
        "<DataArray Name='Diameter' type='Float64' format='ascii'>1 0.5</DataArray>",
        "<DataArray Name='diameter' type='Float64' format='ascii'>1 0.5</DataArray>");
    const auto spheres = spheres_of("s.vtu", vtu(data));
    REQUIRE(spheres.positions.size() == 2);
    CHECK(spheres.positions[1] == Vec3(2, 0, 1));
    CHECK(spheres.radii == std::vector<double>{0.5, 0.25});
    CHECK(spheres.velocities.empty());
    CHECK(spheres.angular_velocities.empty());
}

TEST_CASE("spheres come in the order of their ids", "[sphere_file]")
{
    const auto name = GENERATE(as<std::string>{}, "s.vtu", "s.csv");
    const auto bytes = name == "s.csv"
                           ? "x,y,z,id,radius\n0,0,1,7,0.5\n2,0,1,3,0.25\n"
                           : vtu(radii + "<DataArray Name='id' type='Int32' format='ascii'>7 3</DataArray>");
    const auto spheres = spheres_of(name, bytes);
    CHECK(spheres.positions == std::vector<Vec3>{Vec3(2, 0, 1), Vec3(0, 0, 1)});
    CHECK(spheres.radii == std::vector<double>{0.25, 0.5});
}

TEST_CASE("a .csv file gives its spheres", "[sphere_file]")
{
    const auto spheres = spheres_of("s.csv", "# two\nx,y,z,diameter,vx,vy,vz,wx,wy,wz\n0,0,1,1,1,2,3,4,5,6\n"
                                             "2,0,1,0.5,0,0,0,0,0,-1e-3\n");
    CHECK(spheres.positions == std::vector<Vec3>{Vec3(0, 0, 1), Vec3(2, 0, 1)});
    CHECK(spheres.radii == std::vector<double>{0.5, 0.25});
    CHECK(spheres.velocities == std::vector<Vec3>{Vec3(1, 2, 3), Vec3::Zero()});
    CHECK(spheres.angular_velocities == std::vector<Vec3>{Vec3(4, 5, 6), Vec3(0, 0, -1e-3)});
    CHECK(spheres_of("s.csv", "x,y,z\n0,0,0\n").radii.empty());
}

TEST_CASE("tables of other programs are read, whatever their separators and names", "[sphere_file]")
{
    const std::string rows[] = {"0 0 1 0.5 1 2 3", "2 0 1 0.25 4 5 6"};
    const auto written = [&](const std::string& names, char between) {
        std::string text = names + "\n";
        for (std::string row : rows) {
            std::ranges::replace(row, ' ', between);
            text += row + "\n";
        }
        return text;
    };
    const auto [header, separator] = GENERATE(
        table<std::string, char>({{"x,y,z,radius,vx,vy,vz", ','}, {"x;y;z;r;velocity_x;velocity_y;velocity_z", ';'},
            {"x y z radius vx vy vz", ' '}, {"X\tY\tZ\tRadius\tVX\tVY\tVZ", '\t'},
            {"\"Points:0\",\"Points:1\",\"Points:2\",\"radius\",\"velocity:0\",\"velocity:1\",\"velocity:2\"", ','},
            {"position_x_m,position_y_m,position_z_m,radius_m,velocity_x_m_per_s,velocity_y_m_per_s,velocity_z_m_per_s",
                ','},
            {"x [m];y [m];z [m];radius [m];vx [m/s];vy [m/s];vz [m/s]", ';'}}));
    CAPTURE(header);
    const auto spheres = spheres_of("s.csv", written(header, separator));
    CHECK(spheres.positions == std::vector<Vec3>{Vec3(0, 0, 1), Vec3(2, 0, 1)});
    CHECK(spheres.radii == std::vector<double>{0.5, 0.25});
    CHECK(spheres.velocities == std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)});
}

TEST_CASE("what a file has beyond that is passed over, and said", "[sphere_file]")
{
    const auto spheres = spheres_of("s.csv", "time_s,x,y,z,r,mass,note\n0,1,2,3,4,5,\"a, b\"\n");
    CHECK(spheres.columns == "takes x, y, z, r; passes over time_s, mass, note");
    CHECK(spheres_of("s.csv", "x,y,z\n0,0,0\n").columns == "takes x, y, z");
}

TEST_CASE("a file has materials by name, or by number where the scene has so many", "[sphere_file]")
{
    const SceneFolder folder;
    const std::vector<std::string> known = {"glass", "steel"};
    const auto of = [&](const std::string& header, const std::string& first, const std::string& second) {
        const auto path = folder.write("s.csv", "x,y,z," + header + "\n0,0,0," + first + "\n1,1,1," + second + "\n");
        return read_spheres(path, known).materials;
    };
    const std::vector<std::string> both = {"steel", "glass"};
    CHECK(of("material", "steel", "glass") == both);
    CHECK(of("material", "1", "0") == both);
    CHECK(of("type", "2", "1") == both);
    CHECK(of("type", "3", "1").empty());
    CHECK(of("material", "lead", "glass") == std::vector<std::string>{"lead", "glass"}); // the scene refuses it
}

TEST_CASE("dumps and data files of LAMMPS give their atoms", "[sphere_file]")
{
    const auto dump =
        spheres_of("s.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n"
                             "0 1\n0 1\nITEM: ATOMS id type x y z radius vx vy vz omegax omegay omegaz\n"
                             "1 1 9 9 9 1 0 0 0 0 0 0\nITEM: TIMESTEP\n1\nITEM: ATOMS id type x y z radius vx "
                             "vy vz omegax omegay omegaz\n2 1 2 0 1 0.25 4 5 6 0 0 -1\n1 1 0 0 1 0.5 1 2 3 7 8 9\n");
    const auto data = spheres_of("s.data", "beads\n\n2 atoms\n1 atom types\n\nAtoms # sphere\n\n2 1 0.5 2500 2 0 1\n"
                                           "1 1 1 2500 0 0 1\n\nVelocities\n\n1 1 2 3 7 8 9\n2 4 5 6 0 0 -1\n");
    for (const auto& spheres : {dump, data}) {
        CHECK(spheres.positions == std::vector<Vec3>{Vec3(0, 0, 1), Vec3(2, 0, 1)});
        CHECK(spheres.radii == std::vector<double>{0.5, 0.25});
        CHECK(spheres.velocities == std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)});
        CHECK(spheres.angular_velocities == std::vector<Vec3>{Vec3(7, 8, 9), Vec3(0, 0, -1)});
    }
    CHECK(refusal_of("s.data", "beads\n\nAtoms # atomic\n\n1 1 0 0 0\n") ==
          "s.data:3: atoms of the style 'atomic' have no radii; 'sphere' is read");
    CHECK(refusal_of("s.dump", "ITEM: ATOMS id x y z\n1 0 0\n") == "s.dump:2: here 4 numbers are wanted, not 3");
    CHECK(refusal_of("s.data", "nothing\n") == "s.data: it has no atoms: neither a dump with 'ITEM: ATOMS' nor a data "
                                               "file with 'Atoms # sphere'");
}

TEST_CASE("arrays of other codes' VTK files are taken, and a legacy file is read", "[sphere_file]")
{
    const auto array = [](const std::string& name, const std::string& numbers) {
        return "<DataArray Name='" + name + "' type='Float64' format='ascii' NumberOfComponents='3'>" + numbers +
               "</DataArray>";
    };
    const auto names = GENERATE(table<std::string, std::string>({{"v", "omega"}, {"Velocity", "AngularVelocity"}}));
    const auto spheres = spheres_of(
        "s.vtu", vtu(radii + array(std::get<0>(names), "1 2 3 4 5 6") + array(std::get<1>(names), "7 8 9 0 0 -1")));
    CHECK(spheres.velocities == std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)});
    CHECK(spheres.angular_velocities == std::vector<Vec3>{Vec3(7, 8, 9), Vec3(0, 0, -1)});
    const auto legacy =
        spheres_of("s.vtk", "# vtk DataFile Version 3.0\nbeads\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n"
                            "0 0 1 2 0 1\nVERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\nSCALARS radius double 1\n"
                            "LOOKUP_TABLE default\n0.5 0.25\n");
    CHECK(legacy.positions == std::vector<Vec3>{Vec3(0, 0, 1), Vec3(2, 0, 1)});
    CHECK(legacy.radii == std::vector<double>{0.5, 0.25});
}

TEST_CASE("a broken .csv file of spheres is refused with its line", "[sphere_file]")
{
    CHECK(refusal_of("s.csv", "x,y,z,r\n") == "s.csv:1: no line of numbers follows the header");
    CHECK(refusal_of("s.csv", "x,y,z,x\n1,1,1,1\n") == "s.csv:1: column 'x' is there twice");
    CHECK(refusal_of("s.csv", "x,y,z,\"r\n1,1,1,1\n") == "s.csv:1: a quote is opened and not closed");
    CHECK(refusal_of("s.csv", "id,x,y,z\n1,0,0,0\n2,1,1,1\n1,2,2,2\n") == "s.csv:4: two spheres have the id 1");
    CHECK(refusal_of("s.csv", "radius,a\n1,1\n") == "s.csv:1: the columns 'x', 'y' and 'z' are wanted");
    CHECK(refusal_of("s.csv", "x,y\n1,1\n") == "s.csv:1: of 'x', 'y' and 'z' all must be there");
    CHECK(refusal_of("s.csv", "x,y,z,vx\n1,1,1,1\n") == "s.csv:1: of 'vx', 'vy' and 'vz' all must be there");
    CHECK(refusal_of("s.csv", "x,y,z,radius\n1,1,1,1\n1,1,1,0\n") == "s.csv:3: the radius must be above 0");
    CHECK(refusal_of("s.csv", "x,y,z,diameter\n1,1,1,-1\n") == "s.csv:2: the diameter must be above 0");
    CHECK(refusal_of("s.csv", "x,y,z\n1,1,inf\n") == "s.csv:2: 'inf' is not a finite number");
}

TEST_CASE("a VTK file with wrong numbers is refused with the point", "[sphere_file]")
{
    const auto array = [](const std::string& name, const std::string& numbers, int components = 1) {
        return vtu("<DataArray Name='" + name + "' type='Float64' format='ascii' NumberOfComponents='" +
                   std::to_string(components) + "'>" + numbers + "</DataArray>");
    };
    CHECK(refusal_of("s.vtu", array("radius", "1 0")) == "s.vtu: point 1: the radius must be above 0");
    CHECK(refusal_of("s.vtu", array("diameter", "-2 1")) == "s.vtu: point 0: the diameter must be above 0");
    CHECK(refusal_of("s.vtu", array("radius", "1 2 3 4", 2)) ==
          "s.vtu: array 'radius' must have 1 numbers for each of the 2 points, not 2 for 2");
    CHECK(refusal_of("s.vtu", array("velocity", "1 2")) ==
          "s.vtu: array 'velocity' must have 3 numbers for each of the 2 points, not 1 for 2");
    CHECK(refusal_of("s.vtu", vtu("", "", 0)) == "s.vtu: it has no points");
    CHECK(refusal_of("s.vtu", array("radius", "1 1e999")).starts_with("s.vtu: "));
    CHECK(refusal_of("s.vtu", vtu(radii, "0 0 1 2 0 nan")).starts_with("s.vtu: "));

    // Not-a-number can be written in binary only.
    Simulation simulation;
    State& state = simulation.state;
    add_sphere(state, Vec3(0, 0, std::numeric_limits<double>::quiet_NaN()), 0.01, 2500.0, 0);
    const SceneFolder folder;
    FrameWriter(folder.path()).write_particles(simulation);
    const auto frame = folder.path() / "frames/particles_000000.vtp";
    CHECK(error_of<InputError>([&] { read_spheres(frame); }) ==
          frame.string() + ": the position of point 0 is not a finite number");
}

TEST_CASE("a file that VTK cannot read is refused with its reason on one line, and nothing is printed", "[sphere_file]")
{
    ErrorStream errors;
    const std::string whole = vtu(radii);
    for (const std::string& bytes : {std::string("rubbish"), whole.substr(0, whole.size() / 2), whole + "tail",
             std::string("<VTKFile type='PolyData'><PolyData/></VTKFile>"), std::string("<a/>"),
             vtu(radii, "0 0 1  2 0 1", 3), vtu(radii, "0 0 1  2 0 x"), vtu(radii, "0 0 1  2 0 1", 2000000000)}) {
        CAPTURE(bytes);
        const std::string refusal = refusal_of("s.vtu", bytes);
        CHECK(refusal.starts_with("s.vtu: "));
        CHECK(refusal.find('\n') == std::string::npos);
    }
    CHECK(errors.printed().empty());
    std::fputs("heard", stderr); // so that the test can fail
    CHECK(errors.printed() == "heard");
}

TEST_CASE("sizes that no file can have are refused", "[sphere_file]")
{
    // A compressed array whose header says that it has more blocks than there can be.
    Simulation simulation;
    State& state = simulation.state;
    add_sphere(state, Vec3::Zero(), 0.01, 2500.0, 0);
    const SceneFolder folder;
    FrameWriter(folder.path()).write_particles(simulation);
    const auto frame = folder.path() / "frames/particles_000000.vtp";
    std::string bytes = read_file(frame);
    const std::size_t data = bytes.find("<AppendedData");
    REQUIRE(data != std::string::npos);
    const std::size_t blocks = bytes.find('_', data) + 1;
    bytes.replace(blocks, 8, std::string("\xff\xff\xff\xff\xff\xff\xff\x0f", 8));
    const std::string refusal = refusal_of("s.vtp", bytes);
    CHECK(refusal.starts_with("s.vtp: VTK cannot read it: "));
    CHECK(refusal.find('\n') == std::string::npos);
}

TEST_CASE("a file of spheres that is missing, empty, or of another kind is refused", "[sphere_file]")
{
    CHECK(refusal_of("s.vtp", "") == "s.vtp: the file is empty");
    CHECK(refusal_of("s.doc", "1 2 3") == "s.doc: spheres are read from .csv, .txt, .vtp, .vtu and .vtk files, and "
                                          "from LAMMPS's .dump, .lammpstrj and .data");
    const SceneFolder folder;
    for (const char* name : {"none.vtp", "none.vtu", "none.csv"})
        CHECK(folder.without_folder(error_of<InputError>([&] { read_spheres(folder.path() / name); })) ==
              std::string(name) + ": no such file");
    std::filesystem::create_directory(folder.path() / "folder.vtu");
    CHECK(folder.without_folder(error_of<InputError>([&] { read_spheres(folder.path() / "folder.vtu"); })) ==
          "folder.vtu: not a VTK file");
}
