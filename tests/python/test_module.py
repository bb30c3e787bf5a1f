# SPDX-License-Identifier: GPL-3.0-or-later
"""The module as a program uses it, and beside the program `talus`, whose bits it must have."""
import os
import random
import signal
import struct
import subprocess
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import numpy
import talus
from small_scene import box_of_beads

TALUS = os.environ["TALUS"]
CLOCK_BYTES = 11 * 2 * 8  # the end of a checkpoint: times of the phases


def state_in(checkpoint):
    """What a checkpoint holds, without its header, which has a checksum, and the times by the clock."""
    data = Path(checkpoint).read_bytes()
    size, = struct.unpack("<Q", data[8 + 4 + 4 + 8 + len(talus.__version__):][:8])
    return data[-size:-CLOCK_BYTES]


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file_of(self, scene):
        """A scene as a file, by way of its dict."""
        path = self.folder / "box.toml"
        path.write_text(talus.check(scene)["resolved"])
        return path


class Scenes(InFolder):
    def test_all_forms_are_the_same_scene(self):
        told = talus.check(box_of_beads())
        self.assertEqual(told["spheres"], 120)
        path = self.file_of(box_of_beads())
        for form in (path, str(path), path.read_text()):
            self.assertEqual(talus.check(form)["resolved"], told["resolved"])
        self.assertIn("hopper", talus.scenes())
        self.assertEqual(talus.check("hopper")["name"], "hopper")

    def test_changes_take_values_of_python(self):
        changed = talus.check(box_of_beads(), {"contact.glass-glass.friction": numpy.float64(0.25), "fill.0.count": 3,
                                               "fill.0.diameter": "5 mm", "title": 'a "b"'})
        self.assertEqual((changed["spheres"], changed["diameters"][0], changed["title"]), (3, 0.005, 'a "b"'))

    def test_errors_have_their_place(self):
        text = '[materials.glass]\ndensity = 2500.0\n\n[[wall]]\nname = "floor"\nmaterial = "glass"\nshap = "plane"\n'
        with self.assertRaisesRegex(talus.SceneError, "did you mean 'shape'") as caught:
            talus.Simulation(text)
        self.assertEqual((caught.exception.line, caught.exception.column), (7, 1))
        path = self.folder / "bad.toml"
        path.write_text(text)
        with self.assertRaises(talus.SceneError) as caught:
            talus.Simulation(path)
        self.assertEqual(caught.exception.file, str(path))

    def test_errors_in_a_dict_name_the_key(self):
        wrong = box_of_beads(wall=[{"name": "floor", "shape": "plane", "material": "glas"}])
        with self.assertRaisesRegex(talus.SceneError, r"^wall\[0\]\.material: ") as caught:
            talus.Simulation(wrong)
        self.assertIsNone(caught.exception.line)

    def test_other_errors(self):
        for scene, changes, words in (("nowhere", None, "there is no scene"),
                                      (box_of_beads(), {"fill.0.count": -1}, "set"),
                                      (box_of_beads(), {"wall.lid.radius": 1.0}, "no wall 'lid'")):
            with self.subTest(words), self.assertRaisesRegex(talus.SceneError, words):
                talus.Simulation(scene, changes)
        with self.assertRaises(TypeError):
            talus.Simulation(box_of_beads(title=object()))
        self.assertIn("hole_radius", talus.keys("wall"))

    def test_warnings_are_pythons(self):
        with self.assertWarnsRegex(talus.StepWarning, "times the automatic one"):
            talus.Simulation(box_of_beads(), {"time.step": 0.01})


class Bits(InFolder):
    def test_a_run_is_that_of_the_program(self):
        path = self.file_of(box_of_beads())
        subprocess.run([TALUS, "run", path, "-o", self.folder / "a", "--quiet", "--threads", "1"], check=True)
        with talus.Simulation(path, threads=2, out=self.folder / "b") as sim:
            sim.run(until=0.1)
            sim.run(call=lambda s: False, every=0.03)
        same = {file.relative_to(self.folder / "a") for file in (self.folder / "a").rglob("*")}
        self.assertEqual(same, {file.relative_to(self.folder / "b") for file in (self.folder / "b").rglob("*")})
        self.assertEqual(state_in(self.folder / "a/checkpoint.latest"), state_in(self.folder / "b/checkpoint.latest"))
        for file in ("metrics.csv", "frames/particles_000003.vtp", "frames/contacts_000001.vtp", "scene.resolved.toml"):
            self.assertEqual((self.folder / "a" / file).read_bytes(), (self.folder / "b" / file).read_bytes(), file)
        a, b = (talus.Run(self.folder / name).summary() for name in "ab")
        self.assertEqual((a["sensors"], a["error"], a["ledger"]), (b["sensors"], b["error"], b["ledger"]))
        self.assertEqual((a["touched"], b["touched"]), (False, False))

        # without a folder: up to the step before the last, where the checkpoints were taken
        sim = talus.Simulation(path)
        while sim.time + sim.step_length < 0.3 - 1e-3 * sim.step_length:
            sim.step()
        alone = self.folder / "state"
        alone.write_bytes(sim.state())
        self.assertTrue(state_in(self.folder / "a/checkpoint.latest").startswith(state_in(alone)))
        sim.step()
        self.assertEqual(sim.summary()["sensors"], a["sensors"])

    def test_a_folder_goes_on_in_either(self):
        path = self.file_of(box_of_beads())
        for name in "ab":
            with talus.Simulation(path, out=self.folder / name) as sim:
                sim.run(until=0.1)
        self.assertEqual(talus.Run(self.folder / "a").summary()["status"], "interrupted")
        subprocess.run([TALUS, "resume", self.folder / "a", "--quiet"], check=True)
        with talus.resume(self.folder / "b") as sim:
            sim.run()
        self.assertEqual(state_in(self.folder / "a/checkpoint.latest"), state_in(self.folder / "b/checkpoint.latest"))
        with self.assertRaisesRegex(ValueError, "time.duration"), talus.resume(self.folder / "b") as sim:
            sim.run(until=5.0)

    def test_a_saved_state_goes_on_with_the_same_bits(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.05)
        sim.set_force([3], (0.01, 0.0, 0.0))
        sim.wall("box").velocity = (0.0, 0.0, 0.05)
        sim.run(until=0.1)
        sim.wall("box").velocity = (0.0, 0.01, 0.0)
        sim.save(self.folder / "state.chk")
        again = talus.resume(self.folder / "state.chk")
        copy = sim.copy()
        self.assertTrue(again.touched)
        for one in (sim, again, copy):
            one.run(until=0.15)
        for other in (again, copy):
            numpy.testing.assert_array_equal(sim.positions(), other.positions())
            numpy.testing.assert_array_equal(sim.wall("box").position, other.wall("box").position)
        self.assertEqual(sim.state(), again.state())
        self.assertEqual(sim.summary()["sensors"], again.summary()["sensors"])
        self.assertEqual(sim.summary()["error"], again.summary()["error"])

    def test_a_state_under_another_setting(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.2)
        exact = sim.copy({"solver.tolerance": 1e-9, "solver.max_sweeps": 20000})
        rough, fine = sim.copy({"solver.tolerance": 0.5}), sim.copy({"solver.tolerance": 1e-4})
        for one in (exact, rough, fine):
            one.step()
        error = [numpy.linalg.norm(one.velocities() - exact.velocities()) for one in (rough, fine)]
        self.assertTrue(exact.report.converged)
        self.assertLess(error[1], 0.1 * error[0])

    def test_a_damaged_state_is_refused(self):
        path = self.folder / "state.chk"
        talus.Simulation(box_of_beads()).save(path)
        path.write_bytes(path.read_bytes()[:-5])
        with self.assertRaisesRegex(talus.SceneError, "state.chk: it should hold"):
            talus.resume(path)
        with self.assertRaises(talus.SceneError):
            talus.Simulation(box_of_beads()).restore(b"nothing")
        with self.assertRaises(OSError):
            talus.Simulation(box_of_beads()).save(self.folder / "nowhere" / "state.chk")

    def test_a_state_with_a_damaged_byte_is_refused(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.05)
        state = sim.state()
        for seed in range(60):
            draw = random.Random(seed)
            damaged = bytearray(state)
            damaged[draw.randrange(len(state))] ^= 1 << draw.randrange(8)
            cut = state[:draw.randrange(len(state))]
            for wrong in (bytes(damaged), cut, state + b"x"):
                with self.assertRaises(talus.SceneError, msg=f"seed {seed}"):
                    sim.restore(wrong)
        self.assertEqual(sim.state(), state)  # none of them has left a trace

    def test_a_state_of_another_scene_is_refused(self):
        walls = [{"name": f"tilted {k}", "shape": "plane", "normal": [0.1 * k, 0, 1], "material": "glass"}
                 for k in range(6)]
        wide = box_of_beads(wall=walls, sensor=[])
        wide["fill"][0]["region"] = {"shape": "box", "min": [0, 0, 0.1], "max": [0.1, 0.1, 0.3]}
        wide = talus.Simulation(wide)
        wide.run(until=0.05)
        for change in ({"fill.0.count": 5}, {"materials.glass.density": 1.0}, {"world.rotation": False},
                       {"world.max": [0.2, 0.2, 0.9]}, {"seed": 9},
                       {"wall.tilted 0.remove_at": 0.01}, {"fill.0.diameter": 0.002}):
            with self.assertRaisesRegex(talus.SceneError, "another scene: '.*' differs", msg=str(change)):
                wide.copy(change)
        with self.assertRaisesRegex(talus.SceneError, "another scene"):
            talus.Simulation(box_of_beads()).restore(wide.state())

    def test_a_copy_under_another_setting_goes_on_differently(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.05)
        for change in ({"world.gravity": [0, 0, 9.81]}, {"contact.glass-glass.friction": 0.0},
                       {"time.step": 1e-5}, {"solver.stabilisation": "projected"}):
            copy, same = sim.copy(change), sim.copy()
            copy.run(until=0.08)
            same.run(until=0.08)
            self.assertFalse(numpy.array_equal(copy.positions(), same.positions()), msg=str(change))

    def test_files_of_others_are_not_overwritten(self):
        sim = talus.Simulation(box_of_beads())
        for name, write in (("thesis.txt", sim.save), ("thesis.vtp", sim.write_frame), ("empty.chk", sim.save)):
            path = self.folder / name
            path.write_text("" if name.startswith("empty") else "<VTKFile type=\"PolyData\"> of somebody else")
            before = path.read_bytes()
            with self.assertRaisesRegex(OSError, "is not overwritten"):
                write(path)
            self.assertEqual(path.read_bytes(), before)
            path.unlink()
            write(path)
            write(path)

    def test_times_and_threads_that_mean_nothing_are_refused(self):
        sim = talus.Simulation(box_of_beads())
        for times in ({"until": float("nan")}, {"until": float("inf")}, {"until": 0.1, "every": -1.0},
                      {"until": 0.1, "every": float("nan")}, {"until": 0.1, "every": 0.0}):
            with self.assertRaisesRegex(ValueError, "give a time in seconds", msg=str(times)):
                sim.run(call=lambda simulation: None, **times)
        for threads in (-1, 10**6):
            with self.assertRaisesRegex(ValueError, "threads is"):
                talus.Simulation(box_of_beads(), threads=threads)


class Reading(InFolder):
    def test_copies_are_in_the_order_of_ids(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.05)
        numpy.testing.assert_array_equal(sim.ids(), numpy.arange(120))
        order = numpy.argsort(sim.view.ids)
        numpy.testing.assert_array_equal(sim.positions(), sim.view.positions[order])
        numpy.testing.assert_array_equal(sim.velocities(), sim.view.velocities[order])
        numpy.testing.assert_array_equal(sim.radii(), sim.view.radii[order])
        numpy.testing.assert_allclose(sim.masses(), 2500 * 4 / 3 * numpy.pi * sim.radii()**3)
        momentum = sim.masses() @ sim.velocities()
        numpy.testing.assert_allclose(momentum, sim.report.momentum, atol=1e-12)
        self.assertEqual(sim.angular_velocities().shape, (120, 3))

    def test_views_keep_their_step(self):
        sim = talus.Simulation(box_of_beads())
        sim.step()
        view = sim.view
        positions, part, plain = view.positions, view.positions[:5], numpy.asarray(view.positions)
        self.assertTrue(numpy.shares_memory(plain, sim.view.positions))
        with self.assertRaises(ValueError):
            positions[0, 0] = 1.0
        height, before = positions[:, 2].mean(), plain.copy()
        computed = positions + 1.0
        sim.step()
        for kept in (positions, plain, numpy.asarray(memoryview(positions)), positions.T.T):
            numpy.testing.assert_array_equal(kept, before)
        numpy.testing.assert_array_equal(computed, before + 1.0)
        numpy.testing.assert_array_equal(part, before[:5])
        self.assertNotEqual(view.positions[:, 2].mean(), height)

    def test_a_view_changes_no_bits(self):
        sims = [talus.Simulation(box_of_beads()) for _ in range(2)]
        held = []
        for _ in range(30):
            held.append(sims[0].view.velocities)
            for sim in sims:
                sim.step()
        self.assertEqual(sims[0].state(), sims[1].state())

    def test_contacts_carry_the_weight(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.6)
        contacts = sim.contacts()
        self.assertEqual(contacts.dtype.names, ("a", "b", "wall", "point", "normal", "gap", "compression", "force"))
        at_wall = contacts[contacts["wall"] == sim.wall_names.index("box")]
        weight = sim.masses().sum() * 9.81
        numpy.testing.assert_allclose(at_wall["force"].sum(axis=0), -sim.wall("box").force, atol=1e-9)
        self.assertAlmostEqual(sim.wall("box").force[2], -weight, delta=0.05 * weight)
        numpy.testing.assert_allclose(numpy.cross(at_wall["point"], -at_wall["force"]).sum(axis=0),
                                      sim.wall("box").torque, atol=1e-4 * weight)
        between = contacts[contacts["wall"] < 0]
        apart = sim.positions()[between["a"]] - sim.positions()[between["b"]]
        numpy.testing.assert_allclose(apart / numpy.linalg.norm(apart, axis=1)[:, None], between["normal"], atol=1e-2)

    def test_sensors(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.3)
        found = sim.sensors()["on_box"]["force_z"]
        self.assertEqual(found.unit, "N")
        self.assertGreater(found.spread, 0.0)
        self.assertLess(sim.sensor("on_box")["force_z"], 0.0)
        with self.assertRaises(KeyError):
            sim.sensor("nowhere")
        self.assertEqual(sim.summary()["status"], "done")

    def test_frames(self):
        sim = talus.Simulation(box_of_beads())
        with talus.Simulation(box_of_beads(), out=self.folder / "run") as run:
            run.run()
        sim.run(until=0.2)
        frame = talus.Run(self.folder / "run").frame(time=0.21)
        self.assertAlmostEqual(frame.time, 0.2, delta=sim.step_length)
        numpy.testing.assert_allclose(frame.positions, sim.positions(), rtol=1e-6)
        numpy.testing.assert_allclose(frame.velocities, sim.velocities(), rtol=1e-6, atol=1e-12)
        sim.write_frame(self.folder / "one.vtp")
        self.assertEqual((self.folder / "one.vtp").read_bytes(),
                         (self.folder / "run/frames/particles_000002.vtp").read_bytes())
        self.assertEqual(talus.Run(self.folder / "run").sensors(), run.sensors())


class Changing(InFolder):
    def test_a_driven_wall_takes_the_beads_along(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.3)
        box, height = sim.wall("box"), sim.positions()[:, 2].mean()
        numpy.testing.assert_array_equal(box.velocity, 0.0)
        start = box.position
        box.velocity = (0.0, 0.0, 0.2)
        sim.run(until=0.5)
        numpy.testing.assert_allclose(box.position - start, (0, 0, 0.2 * 0.2), atol=0.2 * sim.step_length)
        self.assertAlmostEqual(sim.positions()[:, 2].mean(), height + 0.04, delta=0.004)
        for k in range(20):  # a servo sets it in every step
            box.velocity = (0.0, 0.0, 0.01 * k)
            sim.step()
        moved = 0.04 + sum(0.01 * k for k in range(20)) * sim.step_length
        self.assertAlmostEqual((box.position - start)[2], moved, delta=0.2 * sim.step_length)
        self.assertTrue(sim.touched and sim.summary()["touched"])
        with self.assertRaisesRegex(ValueError, "no load"):
            box.load = 1.0
        with self.assertRaisesRegex(ValueError, "finite"):
            box.velocity = (0.0, 0.0, numpy.nan)

    def test_a_load_is_carried(self):
        lid = {"name": "lid", "shape": "disk", "center": [0.025, 0.025, 0.19], "radius": 0.024, "material": "glass",
               "mass": 0.1, "guide": [0, 0, -1]}
        sim = talus.Simulation(box_of_beads(wall=[*box_of_beads()["wall"], lid]))
        sim.run(until=0.6)
        plate = sim.wall("lid")
        self.assertEqual(plate.load, 0.0)
        plate.load = 50.0
        sim.run(until=0.9)
        self.assertAlmostEqual(plate.force[2], 50.0 + 0.1 * 9.81, delta=1.0)
        with self.assertRaisesRegex(ValueError, "finite mass"):
            plate.velocity = (0, 0, 1)
        plate.load = 5.0
        again = talus.Simulation(sim.resolved, state=sim.state())
        self.assertEqual(again.wall("lid").load, 5.0)

    def test_own_forces(self):
        scene = box_of_beads(fill=[{"arrangement": "single", "material": "glass", "diameter": 0.01,
                                    "position": [x, 0.025, 0.1]} for x in (0.01, 0.03)])
        sim = talus.Simulation(scene)
        sim.set_force(0, -sim.masses()[0] * sim.gravity)
        sim.run(until=0.05)
        numpy.testing.assert_allclose(sim.velocities()[0], 0.0, atol=1e-12)
        self.assertAlmostEqual(sim.velocities()[1, 2], -9.81 * sim.time, places=9)
        sim.set_force([0, 1], [(0.0, 0.0, 0.0), (0.0, 1e-3, 0.0)])
        sim.run(until=0.06)
        numpy.testing.assert_array_equal(sim.forces()[:, 1], [0.0, 1e-3])
        self.assertGreater(sim.velocities()[1, 1], 0.0)
        error = sim.summary()["error"]
        self.assertLess(error["momentum"]["left_over"], 1e-12)
        self.assertLess(error["energy"]["gained"], 1e-12)
        with self.assertRaises(KeyError):
            sim.set_force([7], (0, 0, 0))

    def test_spheres_come_and_go(self):
        sim = talus.Simulation(box_of_beads())
        sim.run(until=0.1)
        ids = sim.add([(0.01, 0.025, 0.15), (0.04, 0.025, 0.15)], 0.01, "glass", velocity=(0, 0, -1))
        numpy.testing.assert_array_equal(ids, [120, 121])
        sim.step()
        sim.remove([0, 5, 121])
        self.assertEqual(sim.count, 119)
        self.assertEqual(sim.contacts().size, 0)  # they named spheres that have moved up in memory
        sim.run(until=0.3)
        numpy.testing.assert_array_equal(sim.ids(), [k for k in range(121) if k not in (0, 5)])
        ledger = sim.summary()["ledger"]
        self.assertEqual((ledger["inserted"], ledger["inside"], ledger["taken_out"]), (122, 119, 3))
        self.assertTrue(ledger["closes"])
        for diameter, material, place in ((0.02, "glass", (0, 0, 0.1)), (0.01, "gold", (0, 0, 0.1)),
                                          (0.01, "glass", (0, 0))):
            with self.assertRaises((ValueError, KeyError)):
                sim.add(place, diameter, material)
        with self.assertRaises(KeyError):
            sim.remove([121])

    def test_a_touched_run_says_so(self):
        with talus.Simulation(box_of_beads(), out=self.folder / "run") as sim:
            sim.run(until=0.1)
            sim.wall("box").velocity = (0.0, 0.0, 0.1)
            sim.run(until=0.15)
        subprocess.run([TALUS, "resume", self.folder / "run", "--quiet"], check=True)
        run = talus.Run(self.folder / "run")
        self.assertTrue(run.summary()["touched"])
        straight = talus.Simulation(box_of_beads())
        straight.run(until=0.1)
        straight.wall("box").velocity = (0.0, 0.0, 0.1)
        straight.run()
        numpy.testing.assert_allclose(run.frame().positions, straight.positions(), rtol=1e-6)
        self.assertTrue(run.frames("moving_walls"))


FALLING = box_of_beads(wall=[], sensor=[], world={"min": [-1.0, -1.0, -0.1], "max": [1.0, 1.0, 1.0]})


class Ending(InFolder):
    def test_incidents(self):
        sim = talus.Simulation(FALLING, {"time.duration": 1.0})
        with self.assertRaisesRegex(talus.Incident, "left the world where there is no outlet") as caught:
            sim.run()
        self.assertEqual(caught.exception.incidents[0]["kind"], "escaped")
        self.assertLess(sim.time, 0.5)
        self.assertEqual(sim.summary()["status"], "failed")
        with self.assertRaises(talus.Incident):
            sim.step()

    def test_what_escapes_is_taken_out_where_the_scene_says_so(self):
        sim = talus.Simulation(FALLING, {"world.on_escape": "remove"})
        sim.run(call=lambda s: None)  # step by step
        ledger = sim.summary()["ledger"]
        self.assertTrue(ledger["closes"] and ledger["escaped"] == 120)

    def test_a_call_ends_a_run(self):
        sim, times = talus.Simulation(box_of_beads()), []
        self.assertFalse(sim.run(until=0.2, every=0.02, call=lambda s: times.append(s.time) or len(times) == 4))
        numpy.testing.assert_allclose(times, [0.02, 0.04, 0.06, 0.08], atol=sim.step_length)
        self.assertTrue(sim.run(until=0.1))

    def test_ctrl_c(self):
        sim = talus.Simulation(box_of_beads())
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            sim.run(until=1e6)
        steps = sim.steps
        sim.step()
        self.assertEqual(sim.steps, steps + 1)

    def test_other_threads_go_on_and_are_kept_out(self):
        sim = talus.Simulation(box_of_beads())
        done = threading.Event()
        thread = threading.Thread(target=lambda: (sim.run(until=0.5), done.set()))
        thread.start()
        refused = 0
        while not done.is_set():  # reached only if the lock of Python is free in a step
            try:
                sim.positions()
            except RuntimeError as error:
                self.assertIn("another thread", str(error))
                refused += 1
        thread.join()
        self.assertGreater(refused, 0)
        self.assertEqual(sim.count, 120)

    def test_a_folder_is_not_overwritten(self):
        talus.Simulation(box_of_beads(), out=self.folder / "run").close()
        with self.assertRaisesRegex(talus.SceneError, "run"):
            talus.Simulation(box_of_beads(), out=self.folder / "run")
        talus.Simulation(box_of_beads(), out=self.folder / "run", force=True).close()


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
