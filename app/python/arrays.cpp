// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/python/arrays.hpp"

#include "core/contacts/loads.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace talus::python
{
namespace
{

namespace py = pybind11;

/// A contact as Python sees it.
struct ContactRow {
    std::int64_t a, b; ///< ids; b −1 at a wall
    std::int32_t wall; ///< index, −1 between spheres
    double point[3], normal[3];
    double gap;
    double compression; ///< κ of its spring [m]; −inf: it keeps none
    double force[3];    ///< on a [N]
};

[[noreturn]] void refuse_name(const std::string& name)
{
    throw std::invalid_argument("spheres have no " + name);
}

template <class Number, class Value> py::array by_id(Session& session, Value&& value)
{
    const auto& order = session.order();
    py::array_t<Number> array(static_cast<py::ssize_t>(order.size()));
    Number* out = array.mutable_data();
    for (const std::size_t i : order) *out++ = static_cast<Number>(value(i));
    return array;
}

template <class Value> py::array vectors_by_id(Session& session, Value&& value)
{
    const auto& order = session.order();
    py::array_t<double> array({static_cast<py::ssize_t>(order.size()), py::ssize_t{3}});
    double* out = array.mutable_data();
    for (const std::size_t i : order) {
        const Vec3 vector = value(i);
        out = std::copy(vector.data(), vector.data() + 3, out);
    }
    return array;
}

void write(const Vec3& vector, double* out)
{
    std::copy(vector.data(), vector.data() + 3, out);
}

} // namespace

void register_records()
{
    PYBIND11_NUMPY_DTYPE(ContactRow, a, b, wall, point, normal, gap, compression, force);
}

py::array copy_of(Session& session, const std::string& name)
{
    const State& state = session.now().state;
    if (name == "positions") return vectors_by_id(session, [&](std::size_t i) { return state.position[i]; });
    if (name == "velocities") return vectors_by_id(session, [&](std::size_t i) { return state.body(i).velocity; });
    if (name == "angular_velocities")
        return vectors_by_id(session, [&](std::size_t i) { return state.angular_velocity(i); });
    if (name == "own_forces")
        return vectors_by_id(
            session, [&](std::size_t i) { return state.own_force.empty() ? Vec3(0, 0, 0) : state.own_force[i]; });
    if (name == "radii") return by_id<double>(session, [&](std::size_t i) { return state.radius[i]; });
    if (name == "masses") return by_id<double>(session, [&](std::size_t i) { return state.mass(i); });
    if (name == "materials") return by_id<std::int32_t>(session, [&](std::size_t i) { return state.material[i]; });
    if (name == "ids") return by_id<std::int64_t>(session, [&](std::size_t i) { return state.id[i]; });
    refuse_name(name);
}

py::array view_of(Session& session, const std::string& name)
{
    const State& state = session.now().state;
    const auto keeper = py::capsule(new std::shared_ptr<Lease>(session.lease()),
        [](void* lease) { delete static_cast<std::shared_ptr<Lease>*>(lease); });
    const auto count = static_cast<py::ssize_t>(state.count());
    const auto array = [&]<class Number>(const Number* first, std::size_t stride, bool vectors) -> py::array {
        std::vector<py::ssize_t> shape = {count}, strides = {static_cast<py::ssize_t>(stride)};
        if (vectors) {
            shape.push_back(3);
            strides.push_back(sizeof(Number));
        }
        py::array_t<Number> view(shape, strides, first, keeper);
        view.attr("flags").attr("writeable") = false;
        return view;
    };
    if (name == "positions") return array(count ? state.position[0].data() : nullptr, sizeof(Vec3), true);
    if (name == "velocities") return array(count ? state.bodies[0].velocity.data() : nullptr, sizeof(Body), true);
    if (name == "radii") return array(state.radius.data(), sizeof(double), false);
    if (name == "materials") return array(state.material.data(), sizeof(std::int32_t), false);
    if (name == "ids") return array(state.id.data(), sizeof(std::int64_t), false);
    refuse_name(name);
}

py::array contacts_of(Session& session)
{
    const Simulation& simulation = session.now();
    const State& state = simulation.state;
    const double h = simulation.network.carried.impulse_step;
    std::vector<ContactRow> rows;
    const auto add = [&](const Contact& c, std::int64_t b, std::int32_t wall) {
        ContactRow& row = rows.emplace_back();
        row.a = state.id[c.a];
        row.b = b;
        row.wall = wall;
        row.gap = c.gap;
        row.compression = c.compression;
        write(state.position[c.a] - state.radius[c.a] * c.normal, row.point);
        write(c.normal, row.normal);
        write(c.impulse / h, row.force);
    };
    for_each_loaded_sphere_contact(simulation.network, [&](const Contact& c) { add(c, state.id[c.b], -1); });
    for_each_loaded_wall_contact(simulation.network, [&](const Contact& c) { add(c, -1, c.b); });
    return py::array_t<ContactRow>(static_cast<py::ssize_t>(rows.size()), rows.data());
}

Vec3 vector_from(const py::array& given, const std::string& what)
{
    const auto numbers = py::array_t<double, py::array::forcecast>::ensure(given);
    if (!numbers || numbers.ndim() != 1 || numbers.size() != 3)
        throw std::invalid_argument(what + " must be three numbers");
    const Vec3 vector(numbers.at(0), numbers.at(1), numbers.at(2));
    if (!vector.allFinite()) throw std::invalid_argument(what + " must be three finite numbers");
    return vector;
}

py::array_t<double> array_from(const Vec3& vector)
{
    return py::array_t<double>(3, vector.data());
}

} // namespace talus::python
