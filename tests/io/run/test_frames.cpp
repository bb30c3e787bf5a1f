// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/frames.hpp"
#include "tests/io/scene_folder.hpp"
#include "tests/support/contacts.hpp"
#include "tests/support/regions.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

vtkSmartPointer<vtkPolyData> read_frame(const std::filesystem::path& path)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

Vec3 tuple(vtkDataSetAttributes* data, const char* name, vtkIdType index)
{
    vtkDataArray* array = data->GetArray(name);
    REQUIRE(array);
    REQUIRE(array->GetNumberOfComponents() == 3);
    return Vec3(array->GetTuple3(index));
}

double value(vtkFieldData* data, const char* name, vtkIdType index)
{
    vtkDataArray* array = data->GetArray(name);
    REQUIRE(array);
    REQUIRE(array->GetNumberOfComponents() == 1);
    return array->GetTuple1(index);
}

/// Sphere 1 rests on a floor (wall 1; wall 0 is gone), and sphere 0 on sphere 1. Storage order is not that of ids.
Simulation stack_of_two()
{
    Simulation simulation;
    simulation.model.materials = {{{"glass", 2500.0}}, {ContactLaw{.friction = 0.5}}};
    simulation.model.time_step = 1e-3;
    simulation.model.mean_diameter = 1.0;
    simulation.model.world = {Vec3(-1, -1, -1), Vec3(1, 1, infinity)};
    simulation.model.walls = {{"lid", Plane{}, 0, 0.0, 0.5}, {"floor", Plane{}, 0, 0.0, infinity}};
    State& state = simulation.state;
    add_sphere(state, Vec3(0, 0, 0.5), 0.5, 2500, 0, Vec3(1, 2, 3), Vec3(4, 5, 6));
    add_sphere(state, Vec3(0, 0, 1.5), 0.5, 2500, 0);
    state.id = {1, 0};
    state.time = 0.75;
    ContactNetwork& network = simulation.network;
    network.carried.impulse_step = simulation.model.time_step;
    TileContacts& spheres = network.contacts.spheres.emplace_back();
    test::set_contact(spheres, spheres.append(), {.a = 1, .b = 0, .impulse = Vec3(0.001, 0, 0.003)});
    test::set_contact(spheres, spheres.append(), {.a = 1, .b = 0}); // without an impulse
    TileContacts& walls = network.contacts.walls.emplace_back();
    test::set_contact(walls, walls.append(), {.a = 0, .b = 1, .impulse = Vec3(0, 0, 0.012), .gap = -0.125});
    return simulation;
}

} // namespace

TEST_CASE("a particle frame has the spheres in the order of their ids, in one cell", "[frames]")
{
    const SceneFolder folder;
    FrameWriter(folder.path()).write_particles(stack_of_two());
    const auto frame = read_frame(folder.path() / "frames/particles_000000.vtp");
    REQUIRE(frame->GetNumberOfPoints() == 2);
    CHECK(frame->GetNumberOfCells() == 1);
    CHECK(frame->GetPoints()->GetDataType() == VTK_FLOAT);
    CHECK(Vec3(frame->GetPoint(0)) == Vec3(0, 0, 1.5));
    vtkPointData* data = frame->GetPointData();
    CHECK(data->GetArray("id")->GetDataType() == VTK_INT);
    for (const int id : {0, 1}) CHECK(value(data, "id", id) == id);
    CHECK(value(data, "radius", 1) == 0.5);
    CHECK(value(data, "material", 1) == 0);
    CHECK(tuple(data, "velocity", 1) == Vec3(1, 2, 3));
    CHECK(tuple(data, "angular_velocity", 1) == Vec3(4, 5, 6));
    CHECK(value(frame->GetFieldData(), "TimeValue", 0) == 0.75);
    CHECK(frame->GetFieldData()->GetAbstractArray("units")->GetVariantValue(0).ToString() == "SI");
}

TEST_CASE("a contact frame has a line with force and ids for each loaded contact", "[frames]")
{
    const SceneFolder folder;
    FrameWriter(folder.path()).write_contacts(stack_of_two());
    const auto frame = read_frame(folder.path() / "frames/contacts_000000.vtp");
    REQUIRE(frame->GetNumberOfCells() == 2);
    vtkCellData* data = frame->GetCellData();

    // Between the spheres: from the centre of id 0 to that of id 1.
    CHECK(Vec3(frame->GetPoint(0)) == Vec3(0, 0, 1.5));
    CHECK(Vec3(frame->GetPoint(1)) == Vec3(0, 0, 0.5));
    CHECK(tuple(data, "force", 0).isApprox(Vec3(1, 0, 3), 1e-6));
    CHECK(value(data, "normal_force", 0) == Approx(3.0));
    CHECK(value(data, "id_a", 0) == 0);
    CHECK(value(data, "id_b", 0) == 1);
    CHECK(value(data, "wall", 0) == -1);

    // At the floor: down to where it touches, an eighth above the sphere's lowest point.
    CHECK(Vec3(frame->GetPoint(3)) == Vec3(0, 0, 0.125));
    CHECK(value(data, "normal_force", 1) == Approx(12.0));
    CHECK(value(data, "gap", 1) == -0.125);
    CHECK(value(data, "id_a", 1) == 1);
    CHECK(value(data, "id_b", 1) == -1);
    CHECK(value(data, "wall", 1) == 1);
}

TEST_CASE("the force of a contact is that of the last sub-step, and its line ends in the other centre", "[frames]")
{
    Simulation simulation = stack_of_two();
    simulation.network.carried.impulse_step = 0.25 * simulation.model.time_step;
    simulation.state.position[1].z() = 1.25; // an overlap of a quarter
    TileContacts& spheres = simulation.network.contacts.spheres[0];
    Contact contact = spheres.contact(0);
    contact.gap = -0.25;
    test::set_contact(spheres, 0, contact);
    const SceneFolder folder;
    FrameWriter(folder.path()).write_contacts(simulation);
    const auto frame = read_frame(folder.path() / "frames/contacts_000000.vtp");
    CHECK(Vec3(frame->GetPoint(0)) == Vec3(0, 0, 1.25));
    CHECK(Vec3(frame->GetPoint(1)) == Vec3(0, 0, 0.5));
    CHECK(tuple(frame->GetCellData(), "force", 0).isApprox(Vec3(4, 0, 12), 1e-6));
    CHECK(value(frame->GetCellData(), "normal_force", 0) == Approx(12.0));
}

TEST_CASE("contacts with less than the threshold of mean forces are left out", "[frames]")
{
    const SceneFolder folder;
    OutputChoice output;
    output.contact_threshold = 1.0; // forces 3.2 N and 12 N
    FrameWriter(folder.path(), output).write_contacts(stack_of_two());
    const auto frame = read_frame(folder.path() / "frames/contacts_000000.vtp");
    REQUIRE(frame->GetNumberOfCells() == 1);
    CHECK(value(frame->GetCellData(), "wall", 0) == 1);
}

TEST_CASE("frames hold the arrays that are asked for, and no others", "[frames]")
{
    const SceneFolder folder;
    const Simulation simulation = stack_of_two();
    OutputChoice output;
    output.particle_arrays = {"force", "coordination"};
    output.contact_arrays = {"gap"};
    FrameWriter frames(folder.path(), output);
    frames.write_particles(simulation);
    frames.write_contacts(simulation);

    // Sphere 0 is borne by sphere 1, which is borne by the floor: the forces on each add up.
    const auto spheres = read_frame(folder.path() / "frames/particles_000000.vtp");
    vtkPointData* of_spheres = spheres->GetPointData();
    REQUIRE(of_spheres->GetNumberOfArrays() == 4); // with id and radius
    CHECK(tuple(of_spheres, "force", 0).isApprox(Vec3(1, 0, 3), 1e-6));
    CHECK(tuple(of_spheres, "force", 1).isApprox(Vec3(-1, 0, 9), 1e-6));
    CHECK(value(of_spheres, "coordination", 0) == 1);
    CHECK(value(of_spheres, "coordination", 1) == 2);

    const auto contacts = read_frame(folder.path() / "frames/contacts_000000.vtp");
    REQUIRE(contacts->GetCellData()->GetNumberOfArrays() == 1);
    CHECK(value(contacts->GetCellData(), "gap", 1) == -0.125);
}

TEST_CASE("a region leaves out the spheres and contacts beside it", "[frames]")
{
    const SceneFolder folder;
    const Simulation simulation = stack_of_two();
    OutputChoice output;
    output.region = box(Vec3(-1, -1, 0.9), Vec3(1, 1, 2));
    FrameWriter frames(folder.path(), output);
    frames.write_particles(simulation);
    frames.write_contacts(simulation);
    const auto spheres = read_frame(folder.path() / "frames/particles_000000.vtp");
    REQUIRE(spheres->GetNumberOfPoints() == 1);
    CHECK(value(spheres->GetPointData(), "id", 0) == 0);
    const auto contacts = read_frame(folder.path() / "frames/contacts_000000.vtp");
    REQUIRE(contacts->GetNumberOfCells() == 1);
    CHECK(value(contacts->GetCellData(), "id_b", 0) == 1);
}

TEST_CASE("far from the origin places keep a thousandth of a diameter, and near it 32 bits", "[frames]")
{
    const SceneFolder folder;
    const double far = GENERATE(0.0, 1e3, 1e5, 4634210.0);
    Simulation simulation = stack_of_two();
    for (Vec3& x : simulation.state.position) x += Vec3(0.1, far, 0.1);
    FrameWriter(folder.path()).write_particles(simulation);
    const auto frame = read_frame(folder.path() / "frames/particles_000000.vtp");
    CHECK(frame->GetPoints()->GetDataType() == (far > 20000 ? VTK_DOUBLE : VTK_FLOAT));
    for (vtkIdType k = 0; k < 2; ++k) {
        const Vec3 place(frame->GetPoint(k));
        CHECK((place - simulation.state.position[static_cast<std::size_t>(1 - k)]).norm() < 2e-3);
    }
}

TEST_CASE("a wall frame has the walls that stand at its time", "[frames]")
{
    const SceneFolder folder;
    Simulation simulation = stack_of_two();
    simulation.state.time = 0.0;
    FrameWriter frames(folder.path());
    frames.write_walls(simulation.model, simulation.state);
    simulation.state.time = 0.5;
    frames.write_walls(simulation.model, simulation.state);
    CHECK(read_frame(folder.path() / "frames/walls_000000.vtp")->GetNumberOfCells() == 4);
    const auto after = read_frame(folder.path() / "frames/walls_000001.vtp");
    REQUIRE(after->GetNumberOfCells() == 2);
    CHECK(value(after->GetCellData(), "wall", 0) == 1);
}

TEST_CASE("a frame without spheres or contacts opens too", "[frames]")
{
    const SceneFolder folder;
    FrameWriter frames(folder.path());
    frames.write_particles(Simulation());
    frames.write_contacts(Simulation());
    CHECK(read_frame(folder.path() / "frames/particles_000000.vtp")->GetNumberOfPoints() == 0);
    CHECK(read_frame(folder.path() / "frames/contacts_000000.vtp")->GetPointData());
}
