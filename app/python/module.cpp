// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/findings/findings.hpp"
#include "app/loop/error_looks.hpp"
#include "app/python/arrays.hpp"
#include "app/python/built.hpp"
#include "app/python/session.hpp"
#include "app/python/wall.hpp"
#include "app/system/own_files.hpp"
#include "io/scene/key_table.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/checks.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/ranges.h>

#include <tuple>

/// What Python sees of it. The package's other half, talus/*.py, makes of it what talus/_core.pyi does not show.
namespace talus::python
{
namespace
{

namespace fs = std::filesystem;
namespace py = pybind11;

/// Whatever numpy makes numbers of.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Raises an exception of talus/errors.py.
template <class... Arguments> void raise(const char* name, const Arguments&... arguments)
{
    const py::object type = py::module_::import("talus.errors").attr(name);
    PyErr_SetObject(type.ptr(), type(arguments...).ptr());
}

void translate(std::exception_ptr thrown)
{
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const Stopped& stopped) {
        raise("Incident", stopped.sentence, stopped.incidents);
    } catch (const InputError& error) {
        raise("SceneError", error.what());
    } catch (const UsageError& error) {
        raise("SceneError", error.what());
    } catch (const ArchiveError& error) {
        raise("SceneError", std::string("the state cannot be put back: ") + error.what());
    } catch (const OutputError& error) {
        PyErr_SetString(PyExc_OSError, error.what());
    } catch (const Busy& error) {
        PyErr_SetString(PyExc_RuntimeError, error.what());
    } catch (const std::out_of_range& error) {
        PyErr_SetObject(PyExc_KeyError, py::str(error.what()).ptr());
    }
}

/// A scene that is a path, a name, or, where there is a text, that.
OpenedScene open(const std::string& scene, const std::optional<std::string>& text, const std::vector<std::string>& set)
{
    if (!text) return open_scene({scene, set, std::nullopt, std::nullopt});
    return build_opened(read_scene_text(*text, scene, set), fs::path(scene).stem());
}

std::shared_ptr<Session> make_session(const std::string& scene, const std::optional<std::string>& text,
    const std::vector<std::string>& set, int threads, const std::optional<fs::path>& out, bool force)
{
    auto session = std::make_shared<Session>(open(scene, text, set), threads);
    if (out) session->write_into(*out, force);
    return session;
}

using Measured = std::tuple<std::string, std::string, double, double, std::string>;

std::vector<Measured> measured(Session& session, bool latest)
{
    std::vector<Measured> all;
    for (const auto& sensor : session.now().sensors)
        for (const Measurement& m : latest ? sensor->latest() : sensor->results())
            all.emplace_back(sensor->name, m.name, m.value, m.spread, m.unit);
    return all;
}

void set_forces(Session& session, const std::vector<std::int64_t>& ids, const Numbers& forces)
{
    std::vector<std::size_t> spheres;
    for (const std::int64_t id : ids) spheres.push_back(session.index_of(id));
    const bool has_shape = forces.ndim() == 2 && forces.shape(0) == static_cast<py::ssize_t>(ids.size());
    if (!has_shape || forces.shape(1) != 3)
        throw std::invalid_argument("there must be a force of three numbers for each id");
    Simulation& simulation = session.change();
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const double* force = forces.data(static_cast<py::ssize_t>(k), 0);
        set_own_force(simulation, spheres[k], Vec3(force[0], force[1], force[2]));
    }
}

std::int64_t add_sphere(
    Session& session, const Numbers& position, double diameter, const std::string& material, const Numbers& velocity)
{
    const Vec3 x = vector_from(position, "a position"), v = vector_from(velocity, "a velocity");
    const Model& model = session.now().model;
    if (!(diameter >= model.min_diameter * (1 - 1e-9) && diameter <= model.max_diameter * (1 + 1e-9)))
        throw std::invalid_argument(
            fmt::format("a diameter must be from {:.6g} to {:.6g} m, which the scene's own have", model.min_diameter,
                model.max_diameter));
    if (!model.world.contains(x)) throw std::invalid_argument("a position must be inside the world");
    const auto names = names_of(model.materials.list);
    const auto found = std::ranges::find(names, material);
    if (found == names.end())
        throw std::out_of_range(
            fmt::format("there is no material '{}'; there is {}", material, fmt::join(names, ", ")));
    Simulation& simulation = session.change();
    return simulation.state.id[put_in(simulation, x, diameter, static_cast<int>(found - names.begin()), v)];
}

void remove_spheres(Session& session, const std::vector<std::int64_t>& ids)
{
    std::vector<std::uint8_t> gone(session.now().state.count(), 0);
    for (const std::int64_t id : ids) gone[session.index_of(id)] = 1;
    take_out(session.change(), gone);
}

void write_frame(Session& session, const fs::path& path)
{
    if (is_of_others(path, frame_mark))
        throw OutputError(path.string() + ": is no frame of Talus, and is not overwritten");
    write_particles(session.now(), session.opened().output, path);
}

py::dict check(const std::string& scene, const std::optional<std::string>& text, const std::vector<std::string>& set)
{
    const OpenedScene opened = open(scene, text, set);
    const Simulation& simulation = opened.simulation;
    const OverlapCheck overlaps = check_overlaps(simulation);
    double poured = 0.0;
    for (const Pour& pour : simulation.pours) poured += expected_count(pour, simulation.model.materials);
    using py::literals::operator""_a;
    return py::dict("name"_a = opened.name, "title"_a = opened.scene.title, "spheres"_a = simulation.state.count(),
        "poured"_a = poured, "step_length"_a = simulation.model.time_step, "duration"_a = simulation.duration,
        "diameters"_a = py::make_tuple(
            simulation.model.min_diameter, simulation.model.mean_diameter, simulation.model.max_diameter),
        "overlaps"_a = overlaps.count, "worst_overlap"_a = overlaps.worst, "step"_a = opened.report.step,
        "model"_a = opened.report.model, "world"_a = opened.report.world, "overlap"_a = opened.report.overlap,
        "warnings"_a = opened.report.warnings, "resolved"_a = resolved_scene(opened.scene));
}

void bind_report(py::module_& module)
{
    using Report = StepReport;
    py::class_<Report>(module, "StepReport", "What a step tells of itself.")
        .def_property_readonly(
            "sub_steps", [](const Report& r) { return r.sub_steps; }, "into which it was split")
        .def_property_readonly("sweeps", [](const Report& r) { return r.solve.sweeps; })
        .def_property_readonly("residual", [](const Report& r) { return r.solve.residual; })
        .def_property_readonly(
            "converged", [](const Report& r) { return r.solve.converged; }, "residual <= tolerance")
        .def_property_readonly("contacts", [](const Report& r) { return r.contacts.count; })
        .def_property_readonly(
            "overlapping", [](const Report& r) { return r.contacts.overlapping; }, "contacts")
        .def_property_readonly(
            "worst_overlap", [](const Report& r) { return r.contacts.worst_overlap; }, "[m]")
        .def_property_readonly(
            "mean_overlap", [](const Report& r) { return r.contacts.mean_overlap(); }, "[m]")
        .def_property_readonly(
            "cone_violation", [](const Report& r) { return r.outcome.cone_violation; }, "[N s]")
        .def_property_readonly(
            "kinetic_energy", [](const Report& r) { return r.bodies.kinetic_energy; }, "[J]")
        .def_property_readonly(
            "potential_energy", [](const Report& r) { return r.bodies.potential_energy; }, "[J]")
        .def_property_readonly(
            "contact_energy", [](const Report& r) { return r.contacts.stored_energy; },
            "in the springs of the contacts, when the step began [J]")
        .def_property_readonly(
            "attraction_energy", [](const Report& r) { return r.contacts.attraction_energy; },
            "of all that attract each other, when the step began, not above 0 [J]")
        .def_property_readonly(
            "momentum", [](const Report& r) { return array_from(r.bodies.momentum.linear); },
            "of the spheres, (3,) [N s]")
        .def_property_readonly(
            "fastest", [](const Report& r) { return r.bodies.fastest_speed; }, "[m/s]")
        .def("__repr__", [](const Report& r) {
            return fmt::format("<StepReport: {} contacts, {} sweeps, residual {:.2g}>", r.contacts.count,
                r.solve.sweeps, r.solve.residual);
        });
}

void bind_wall(py::module_& module)
{
    py::class_<WallHandle>(module, "Wall", "A wall, between two steps.")
        .def_property_readonly("name", &WallHandle::name)
        .def_property_readonly(
            "force", [](const WallHandle& w) { return array_from(w.force()); },
            "of the spheres on it, mean over the last step, (3,) [N]")
        .def_property_readonly(
            "torque", [](const WallHandle& w) { return array_from(w.torque()); },
            "of the same about the origin, (3,) [N m]")
        .def_property_readonly(
            "position", [](const WallHandle& w) { return array_from(w.position()); },
            "of the middle of its box, of a plane of its point, (3,) [m]")
        .def_property(
            "velocity", [](const WallHandle& w) { return array_from(w.velocity()); },
            [](WallHandle& w, const Numbers& v) { w.set_velocity(vector_from(v, "a velocity")); },
            "there, (3,) [m/s]. Set, it holds from now on, in place of the motion that the scene tells.")
        .def_property("load", &WallHandle::load, &WallHandle::set_load,
            "along the guide of a wall of finite mass [N]. Set, it holds from now on.")
        .def("__repr__", [](const WallHandle& w) { return fmt::format("<Wall '{}'>", w.name()); });
}

/// Keeps a folder for one process of Talus while it is entered.
class LockedFolder
{
public:
    explicit LockedFolder(fs::path folder) : folder_(std::move(folder)) {}

    void enter()
    {
        lock_ = std::make_unique<FolderLock>(folder_);
        warn_unless_protected(*lock_);
    }

    void leave() { lock_.reset(); }

private:
    fs::path folder_;
    std::unique_ptr<FolderLock> lock_;
};

void bind_lock(py::module_& module)
{
    py::class_<LockedFolder>(module, "_LockedFolder")
        .def(py::init<fs::path>())
        .def("__enter__", &LockedFolder::enter)
        .def("__exit__", [](LockedFolder& lock, const py::args&) { lock.leave(); });
}

/// Findings, and the simulation that they are of.
struct Watch {
    std::shared_ptr<Session> session;
    Findings findings;

    explicit Watch(std::shared_ptr<Session> of)
        : session(std::move(of)), findings(session->now(), session->opened().scene.time.metrics_interval)
    {
    }

    double run(double time, double spent, double longest)
    {
        return session->run_observed(time, spent, longest,
            [&](const StepReport& report, Simulation& simulation) { findings.add(report, simulation); });
    }

    std::vector<std::tuple<std::string, double, double, std::string>> results()
    {
        std::vector<std::tuple<std::string, double, double, std::string>> all;
        for (const Measurement& m : findings.results(session->now()))
            all.emplace_back(m.name, m.value, m.spread, m.unit);
        return all;
    }
};

/// Steps that nobody looks at.
double run_unobserved(Session& session, double time, double spent, double longest)
{
    return session.run_observed(time, spent, longest, [](const StepReport&, Simulation&) {});
}

void bind_findings(py::module_& module)
{
    using py::arg;
    py::class_<Watch>(module, "Findings",
        "What a study wants to know of a run, from now on: how wrong each step is, how the packing rests, what sensors "
        "measure.")
        .def(py::init<std::shared_ptr<Session>>(), arg("simulation"))
        .def("run", &Watch::run, arg("until"), arg("spent") = 0.0, arg("longest") = infinity,
            "Makes steps until a time [s], and looks at them; no more where their CPU time [s], with what was spent "
            "before, is longer than allowed. Returns that time. Raises Incident.")
        .def("results", &Watch::results, "All so far: name, value, spread, unit; those of the sensors last.")
        .def(
            "profile", [](const Watch& w) { return w.findings.profile(); },
            "Mean force by walls and through ten level cuts, by the weight of the spheres at the beginning.")
        .def_property_readonly(
            "contact_updates", [](const Watch& w) { return w.findings.contact_updates(); }, "contacts x sweeps so far")
        .def(
            "velocity_error", [](Watch& w) { return velocity_error_of_next_step(w.session->now()); },
            "How far the velocities are after the next step from those of the same step solved to the end: root of the "
            "mean square [m/s]. The simulation is left where it is.");
    module.def("_run_unobserved", &run_unobserved, arg("simulation"), arg("until"), arg("spent"), arg("longest"));
    module.def("_study_units", [](Session& session) {
        const StudyUnits units(session.now());
        using py::literals::operator""_a;
        return py::dict("diameter"_a = units.diameter, "acceleration"_a = units.acceleration, "speed"_a = units.speed,
            "mass"_a = units.mass);
    });
}

void bind_simulation(py::module_& module)
{
    using py::arg;
    py::class_<Session, std::shared_ptr<Session>>(module, "Simulation")
        .def(py::init(&make_session), arg("scene"), arg("text"), arg("overrides"), arg("threads"), arg("out"),
            arg("force"))
        .def(py::init(&Session::resume), arg("place"), arg("overrides"), arg("threads"))
        .def_property_readonly(
            "name", [](const Session& s) { return s.opened().name; }, "of the scene")
        .def_property_readonly(
            "time", [](Session& s) { return s.now().state.time; }, "simulated [s]")
        .def_property_readonly(
            "steps", [](Session& s) { return s.now().state.steps; }, "made so far")
        .def_property_readonly(
            "step_length", [](Session& s) { return s.now().model.time_step; }, "[s]")
        .def_property_readonly(
            "duration", [](Session& s) { return s.now().duration; }, "as the scene has it [s]")
        .def_property_readonly(
            "count", [](Session& s) { return s.now().state.count(); }, "of spheres")
        .def_property_readonly(
            "gravity", [](Session& s) { return array_from(s.now().model.gravity); }, "(3,) [m/s2]")
        .def_property_readonly(
            "touched", [](Session& s) { return s.now().interventions.any; },
            "whether anything was changed from outside, now or before a resume")
        .def_property_readonly("material_names", [](Session& s) { return names_of(s.now().model.materials.list); })
        .def_property_readonly(
            "wall_names", [](Session& s) { return names_of(s.now().model.walls); }, "by the index that contacts have")
        .def_property_readonly(
            "report", [](Session& s) { return s.now(), s.report(); }, "of the last step")
        .def_property_readonly(
            "resolved", [](const Session& s) { return resolved_scene(s.opened().scene); },
            "the scene with every key written out, as TOML")
        .def("_step", [](Session& s) { s.run_until(s.now().state.time + s.now().model.time_step); })
        .def("_run_until", &Session::run_until)
        .def("_take_warnings", &Session::take_warnings)
        .def("_measured", &measured)
        .def("_summary", &Session::summary)
        .def("_copy", &copy_of)
        .def("_view", &view_of)
        .def("_built", &built_scene)
        .def("_wall", [](const std::shared_ptr<Session>& s, const std::string& name) { return WallHandle(s, name); })
        .def("_set_forces", &set_forces)
        .def("_add", &add_sphere)
        .def("remove", &remove_spheres, arg("ids"), "Takes these spheres out; the ledger of the summary has them.")
        .def("contacts", &contacts_of, "Contacts of the last step that bear something, as an array of records.")
        .def(
            "state", [](Session& s) { return py::bytes(s.state()); },
            "All that changes, but what sensors have seen and the statistics of the run, as bytes for restore().")
        .def(
            "restore", [](Session& s, const py::bytes& state) { s.restore(state); }, arg("state"),
            "Puts back what state() gave of the same scene, perhaps under another setting.")
        .def("save", &Session::save, arg("file"), "Writes a checkpoint of its own, for resume().")
        .def("write_frame", &write_frame, arg("file"), "Writes the spheres as a .vtp file, as in the frames of a run.")
        .def("close", &Session::close, "Ends the run in a folder: last frames, checkpoint, summary.json.");
}

} // namespace
} // namespace talus::python

PYBIND11_MODULE(_core, module)
{
    using namespace talus;
    using namespace talus::python;
    using py::arg;
    module.attr("__version__") = TALUS_VERSION;
    module.attr("source_folder") = TALUS_SOURCE_FOLDER;
    py::register_exception_translator(&translate);
    register_records();
    bind_report(module);
    bind_wall(module);
    bind_simulation(module);
    bind_findings(module);
    bind_lock(module);
    bind_export(module);
    module.def("check", &check, arg("scene"), arg("text"), arg("overrides"));
    module.def("keys", &key_table, arg("table"));
    module.def("scenes", [] {
        std::vector<std::string> names;
        for (const auto& path : supplied_scenes()) names.push_back(path.stem());
        return names;
    });
    module.def("set_own_files", &set_own_files, arg("folder"));
}
