# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of tests/RESULTS.md: what is measured, by which command, how the figures are read, what to compare with."""
import csv
import json
import re
from pathlib import Path
from typing import Callable, NamedTuple

ROOT = Path(__file__).resolve().parents[2]
NUMBER = r"([-+0-9.e]+)"


class ResultsError(Exception):
    """A command that fails, or a figure that is not there; the text is one sentence."""


class Run(NamedTuple):
    """What a command left behind."""
    text: str  # what it printed
    folder: Path  # of the output; talus run only
    seconds: float
    memory: float  # bytes, at the peak

    def summary(self, path):
        value = json.loads((self.folder / "summary.json").read_text())
        for key in path.split("."):
            value = value[key]
        return value

    def column(self, name):
        with open(self.folder / "metrics.csv", newline="", encoding="utf-8") as file:
            return [float(row[name]) for row in csv.DictReader(file)]


Reader = Callable[[Run], float | str]


class Row(NamedTuple):
    """A row of the page: what is measured, how, and what it is to be compared with."""
    name: str
    section: str
    what: str
    command: str
    figures: dict[str, Reader]  # numbers, or text
    shown: str  # format of the figures
    reference: str  # with its source; empty where there is none
    minutes: float  # about, on two processors
    seeds: tuple[int, ...] = ()  # one run for each; a figure is then their mean, NAME_error its standard error


class Table(NamedTuple):
    """A table that a script prints; it stands between the marks "NAME begin" and "NAME end" of a page of its own."""
    name: str
    command: str
    page: Path
    minutes: float
    before: tuple[str, ...] = ()  # commands that make what the script reads


# How figures are read.

def summary(path) -> Reader:
    return lambda run: run.summary(path)


def sensor(path) -> Reader:
    return summary(f"sensors.{path}.value")


def spread(path) -> Reader:
    return summary(f"sensors.{path}.spread")


def ratio(above, below) -> Reader:
    return lambda run: run.summary(above) / run.summary(below)


def change(told):
    """Of a result by step or solver, as the table of a run has it."""
    if told["error"] is None:
        return "?"
    return f"{'below ' if not told['seen'] and told['error'] > 0 else ''}{told['error']:.2g}"


def with_errors(path) -> Reader:
    """A result of `--error-estimate`: value ± spread ± step ± solver, and its unit."""
    def read(run):
        result = run.summary(f"sensors.{path}")
        return (f"{result['value']:.5g} ± {result['spread']:.2g} ± {change(result['step'])} (step) ± "
                f"{change(result['solver'])} (solver) {result['unit']}")
    return read


def beside(phase) -> Reader:
    """CPU seconds of a phase by those of all others but what an error estimate makes."""
    def read(run):
        phases = {name: spent["cpu"] for name, spent in run.summary("timing.phases").items()}
        return phases[phase] / (sum(phases.values()) - phases["looks"] - phases["companions"])
    return read


def said(pattern) -> Reader:
    """The number that stands for N in a pattern, in what the command printed."""
    def read(run):
        found = re.search(re.sub(r"\bN\b", lambda _: NUMBER, pattern), run.text)
        if not found:
            raise ResultsError(f"nothing printed is like '{pattern}'")
        return float(found[1])
    return read


def while_quiet(scene, law) -> dict[str, Reader]:
    """What tests/validation/test_quietness.cpp prints of a bed at rest."""
    line = rf"{scene}, {law}: overlap "
    return {"overlap": said(line + "N d"), "creep": said(line + ".*creep N d/s"),
            "energy": said(line + ".*kinetic energy N m g d"), "swing": said(line + ".*support force rms N,")}


def travel(of_column) -> Reader:
    """Of the plate of scenarios/piston.toml [mm], after the moment when its weight is let go and its load begins."""
    def read(run):
        column = run.column("plate_travel_m")
        begin = next(z for t, z in zip(run.column("time_s"), column) if t >= 1.45)
        return 1e3 * (of_column(column) - begin)
    return read


FLOW = "Flow out of hoppers and silos"
HEAPS = "Heaps, drum and slopes"
REST = "Beds at rest"
WALLS = "Pistons and shaken walls"
COST = "Cost and error of a run"

SILO = "build/talus run tests/validation/scenes/flat_silo.toml"
FUNNEL = "build/talus run tests/validation/scenes/funnel_pile.toml"
HOPPER = "build/talus run hopper --threads 1"
HELD = ("build/talus run piston --set 'wall.plate.load=[[0.4,-17],[0.5,-19.62],[1.25,-19.62],[1.45,0],[2.6,100]]' "
        "--set sensor.plate.from=2.8 --set sensor.on_plate.from=2.8 --set sensor.on_floor.from=2.8 "
        "--set sensor.on_cylinder.from=2.8")
LARGE = ("build/talus run packing --until 0.4 --set fill.0.count=100000 "
         "--set 'fill.0.region.max=[0.46, 0.46, 1.1]' --set 'wall.box.max=[0.46, 0.46, 1.2]'")
SEEDS = (1, 2, 3)
ANGLE = {"angle": sensor("heap.angle"), "error": spread("heap.angle")}
ANGLE_SHOWN = "{angle:.1f} ± {error:.1f}°"
QUIET = "overlap {overlap:.2g} d, median creep {creep:.2g} d/s, kinetic energy {energy:.2g} m g d"


def at_rest(name, what, scene, test, minutes):
    """Two rows, for both laws, from one test of tests/validation/test_quietness.cpp."""
    shown = QUIET + ("; rms swing of the force on the floor {swing:.2%}" if scene == "tube" else "")
    for law, of_these in (("matched", minutes), ("projected", 0.0)):
        yield Row(f"{name}_{law}", REST, f"{what}, `{law}`", f'build/test_validation "{test}"', while_quiet(scene, law),
                  shown, "", of_these)


def estimate(scene, path, minutes):
    """Two rows, of what a run with `--error-estimate` tells of its error, and of what that costs."""
    command = f"build/talus run {scene} --error-estimate --threads 1"
    yield Row(f"{scene}_estimate", COST, f"`{scene} --error-estimate`: {path.replace('.', ' ').replace('_', ' ')}; error of "
              "velocities as a share of what contacts change in a step, and of the flow; of contact forces by their mean",
              command, {"result": with_errors(path), "contacts": summary("error.solver.velocity.of_contacts"),
                        "flow": summary("error.solver.velocity.of_flow"), "forces": summary("error.solver.contact_forces")},
              "{result}; {contacts:.1%}, {flow:.2%}; {forces:.1%}", "", minutes)
    yield Row(f"{scene}_estimate_cost", COST, f"`{scene} --error-estimate`: looks and their steps solved to the end; "
              "companions and their pieces; CPU seconds of both by those of the run", command,
              {"looks": summary("error.solver.looks"), "to_the_end": summary("error.solver.to_the_end"),
               "pieces": summary("error.companions.pieces"), "look_cost": beside("looks"),
               "companion_cost": beside("companions")},
              "{looks:.0f}, {to_the_end:.0f}; {pieces:.0f}; {look_cost:.0%}, {companion_cost:.0%}", "", 0)


ROWS = [
    Row("silo", FLOW, "flat silo, 10 000 beads, outlet of 7 d: spheres a second, mean of three seeds", SILO,
        {"flow": sensor("outlet.sphere_flow")}, "{flow:.0f} ± {flow_error:.0f} /s",
        "1318 ± 11 /s LAMMPS, 1346 ± 18 /s LIGGGHTS 3.8 in one run each; Hertz–Mindlin, same beads and silo", 6, SEEDS),
    Row("silo_exponent", FLOW, "flat silo, outlets of 7, 8.5 and 10.5 d: exponent n in W ∝ (D − 1.4 d)^n",
        'build/test_validation "the discharge grows*"', {"exponent": said("exponent N")}, "{exponent:.2f}",
        "2.60 LIGGGHTS 3.8 from the same bed; 2.55 for these outlets (Mankoc et al. 2007); 2.5 for wide outlets "
        "(Beverloo et al. 1961)", 8),
    Row("hopper", FLOW, "conical hopper, 10 000 beads, outlet of 7 d: spheres a second", HOPPER,
        {"flow": sensor("outlet.sphere_flow"), "error": spread("outlet.sphere_flow")},
        "{flow:.0f} ± {error:.0f} /s", "1981 and 1973 /s LIGGGHTS 3.8, same STL file", 4),
    Row("slot_hopper", FLOW, "wedge-shaped hopper over a slot, periodic in depth: mass flow",
        "build/talus run slot_hopper", {"flow": sensor("slot.mass_flow"), "error": spread("slot.mass_flow")},
        "{flow:.3f} ± {error:.3f} kg/s", "1 to 1.4 times the 0.66 kg/s of a flat bottom (Beverloo et al. 1961)", 1.5),

    Row("pile_plain", HEAPS, "4000 beads poured onto a rough plate: angle of repose", "build/talus run pile_plain",
        ANGLE, ANGLE_SHOWN, "above the 20.9° of steady shear (Chialvo, Sun & Sundaresan 2012)", 2),
    Row("pile_rolling", HEAPS, "4000 beads poured onto a rough plate, rolling resistance 0.1: angle of repose",
        "build/talus run pile", ANGLE, ANGLE_SHOWN, "28.6° LAMMPS, 29.9° LIGGGHTS; 3000 beads through a funnel", 2),
    Row("funnel", HEAPS, "3000 beads through a funnel: angle of repose, mean of three seeds", FUNNEL,
        {"angle": sensor("heap.angle")}, "{angle:.1f} ± {angle_error:.1f}°",
        "23.8 ± 0.3° LIGGGHTS 3.8, 23.8 ± 0.5° LAMMPS; one run each, the same geometry and sensor", 6, SEEDS),
    Row("funnel_rolling", HEAPS, "3000 beads through a funnel, rolling resistance 0.1: angle of repose, mean of three "
        "seeds", FUNNEL + " --set contact.glass-glass.rolling_friction=0.1", {"angle": sensor("heap.angle")},
        "{angle:.1f} ± {angle_error:.1f}°", "29.9 ± 0.5° LIGGGHTS 3.8, 28.6 ± 0.2° LAMMPS; one run each", 6, SEEDS),
    Row("import", HEAPS, "a pile at rest of another program, without rotation: way of the median sphere and mean way "
        "while contacts find their forces; change of the angle; then median creep",
        'build/test_validation "a pile at rest*"',
        {"median": said("import: .*median N,"), "mean": said("import: moved N d on average"),
         "angle": said("angle N N degrees"), "change": said(r"angle \S+ N degrees"), "creep": said("creep N d/s")},
        "{median:.2g} d, {mean:.2g} d; {change:+.2f}° of {angle:.1f}°; {creep:.1g} d/s", "it was at rest there", 1),
    Row("drum", HEAPS, "drum half full, Froude number 1e-3: angle of the surface", "build/talus run drum",
        {"angle": sensor("surface.angle"), "error": spread("surface.angle")}, ANGLE_SHOWN,
        "22 to 27° for spheres with friction 0.5 at 1e-4 to 1e-2", 2),
    Row("column_collapse", HEAPS, "collapse of a column: run-out / radius (foot at 99 % of the mass)",
        'build/test_validation "a column collapses*"',
        {"run_out": said("run-out N radii"), "expected": said("radii, N expected")}, "{run_out:.2f}",
        "1.24 height / radius (Lube et al. 2004): {expected:.2f}", 3),
    Row("slope", HEAPS, "rough slope: mean velocity at 15°; at 24° after 7 and 10 s; at 33° after 3 and 6 s",
        'build/test_validation "on a rough slope*"',
        {"rest": said("15 degrees: N m/s"), "early": said("24 degrees: N m/s at 7"),
         "late": said("24 degrees: .*, N at 10"), "before": said("33 degrees: N m/s at 3"),
         "after": said("33 degrees: .*, N at 6")},
        "{rest:.1g} m/s; {early:.2f}, {late:.2f} m/s; {before:.2f}, {after:.2f} m/s",
        "rest below about 18°, steady flow up to about 32° (Silbert et al. 2001; Weinhart et al. 2012)", 5),

    *at_rest("rest_box", "5000 beads in a box", "packing", "a settled box of 5000*", 2),
    *at_rest("rest_pile", "`pile_plain`", "pile_plain", "a pile does not flow*", 4),
    *at_rest("rest_column", "tube of 100 layers after 2.5 s", "tube", "a column of 100*", 3),

    Row("piston_held", WALLS, "plate of 2 kg on 4000 beads under 100 N: force on the plate; on floor and cylinder",
        HELD,
        {"plate": sensor("on_plate.force_z"),
         "around": lambda run: -sensor("on_floor.force_z")(run) - sensor("on_cylinder.force_z")(run)},
        "{plate:.2f} N; {around:.2f} N", "119.62 N; 130.87 N, weights and load", 1),
    Row("piston_ramp", WALLS, "plate of 2 kg on 4000 beads, load up to 200 N and back: largest travel, what remains; "
        "mean residual, steps at the cap of sweeps", "build/talus run piston",
        {"most": travel(max), "left": travel(lambda column: column[-1]), "residual": summary("error.residual.mean"),
         "capped": summary("error.residual.steps_at_cap")},
        "{most:.2f} mm, {left:.2f} mm; {residual:.1g}, {capped:.0f}", "", 1),
    Row("vibrated_bed", WALLS, "box shaken at 3 g: mean vertical force on it", "build/talus run vibrated_bed",
        {"force": lambda run: -sensor("box.force_z")(run), "error": spread("box.force_z")},
        "{force:.3f} ± {error:.3f} N", "1.926 N, the weight of the beads", 1),

    Row("hopper_error", COST, "`hopper`: residual, mean and worst; steps at the cap; overlap, mean and worst", HOPPER,
        {"mean": summary("error.residual.mean"), "worst": summary("error.residual.worst"),
         "capped": summary("error.residual.steps_at_cap"), "overlap": summary("error.overlap_d.mean"),
         "deepest": summary("error.overlap_d.worst")},
        "{mean:.1g}, {worst:.1g}; {capped:.0f}; {overlap:.2%} d, {deepest:.2%} d", "tolerance 0.01", 0),
    Row("hopper_cost", COST, "`hopper`: CPU seconds for a simulated second, on one thread; share of the search", HOPPER,
        {"cpu": ratio("timing.cpu", "time.simulated"), "search": ratio("timing.phases.search.cpu", "timing.cpu")},
        "{cpu:.0f}; {search:.0%}", "LIGGGHTS 3.8 while it discharges, on a machine of two virtual processors: 31 to 34 "
        "with 5e6 Pa, 62 to 67 with 5e7 Pa", 0),
    Row("hopper_looks", COST, "`hopper`: looks, and what they take beside the CPU seconds of the run", HOPPER,
        {"looks": summary("error.solver.looks"), "cost": beside("looks")}, "{looks:.0f}; {cost:.1%}", "", 0),
    *estimate("hopper", "outlet.mass_flow", 8),
    *estimate("pile", "heap.angle", 8),
    *estimate("drum", "surface.angle", 8),
    Row("large", COST, "100 000 beads fall into a box: seconds a step, memory at the peak, shares of sweeps, search "
        "and assembly in the CPU seconds", LARGE,
        {"step": ratio("timing.wall", "time.steps"), "threads": summary("threads"),
         "memory": lambda run: run.memory / run.summary("ledger.inside"),
         "sweeps": ratio("timing.phases.sweeps.cpu", "timing.cpu"),
         "search": ratio("timing.phases.search.cpu", "timing.cpu"),
         "assembly": ratio("timing.phases.assembly.cpu", "timing.cpu")},
        "{step:.3f} s on {threads:.0f} threads; {memory:.0f} B a sphere; {sweeps:.0%}, {search:.0%}, {assembly:.0%}",
        "", 3),
    Row("checkpoint", COST, "size of a checkpoint of a dense bed, `packing`", "build/talus run packing",
        {"size": lambda run: (run.folder / "checkpoint.latest").stat().st_size / run.summary("ledger.inside")},
        "{size:.0f} B a sphere", "", 1),
]

TABLES = [
    Table("local_solves", "tests/benchmarks/local_solves.py", ROOT / "tests/results/local_solves.md", 0.5),
    Table("siconos", "tests/benchmarks/compare_siconos.py build/frictionless_bed.hdf5 build/flow.hdf5 build/pile.hdf5 "
          "--tolerance 1e-4 1e-8", ROOT / "tests/results/siconos.md", 10,
          ("build/talus dump --force hopper --set contact.0.friction=0 --set contact.1.friction=0 --at 0.6 -o "
           "build/frictionless_bed.hdf5", "build/talus dump --force hopper --at 2.0 -o build/flow.hdf5",
           "build/talus dump --force pile_plain --at 4.5 -o build/pile.hdf5")),
    Table("report_page", "tests/benchmarks/report_page.py", ROOT / "tests/results/report_page.md", 8),
    Table("test_times", "tests/results/test_times.py", ROOT / "tests/results/test_times.md", 5, ("tests/run",)),
    Table("fuzz", "tests/run fuzz 600", ROOT / "tests/results/fuzz.md", 50),
]
