# SPDX-License-Identifier: GPL-3.0-or-later
"""What a process of a study does: a state to start from, or one setting measured."""
import math
import resource
import warnings
from pathlib import Path

import talus
from run_page.writing import write_whole
from studies.statistics import MeanAndError

LOOKS = 3  # how often the velocity error is taken: it is of one step, and differs from step to step


def open_setting(frame, overrides, seed):
    warnings.simplefilter("ignore", talus.StepWarning)
    return talus.Simulation(frame["scene"], set=[*frame["set"], *overrides, f"seed={seed}", f"time.duration={frame['end']!r}"], threads=1)


def start_path(folder, seed):
    return Path(folder) / f"start_of_seed_{seed}.state"


def make_start(frame, seed):
    """Runs the scene's own setting up to the start, and keeps the state. Returns a sentence where it fails."""
    try:
        simulation = open_setting(frame, [], seed)
        talus._core._run_unobserved(simulation, frame["start"], 0.0, math.inf)
        write_whole(start_path(frame["folder"], seed), simulation.state())
    except (talus.SceneError, talus.Incident, OSError) as error:
        return str(error)
    return ""


def run_setting(frame, name, overrides, seed):
    """Runs one setting from the state kept for a seed, on one thread: lets it settle, and measures. Whatever goes wrong
    is the row's status."""
    row = {"setting": name, "seed": seed, "status": "done", "cpu_s_per_s": 0.0, "contact_updates_per_s": 0.0, "memory_B": 0.0, "findings": [], "profile": []}
    try:
        simulation = open_setting(frame, overrides, seed)
        simulation.restore(start_path(frame["folder"], seed).read_bytes())
        row.update(measured(simulation, frame))
    except GivenUp as given_up:
        row["status"] = f"given up after {given_up.args[0]:.3g} s of CPU, at t = {simulation.time:.4g} s"
    except (talus.SceneError, talus.Incident, OSError) as error:
        row["status"] = str(error)
    row["memory_B"] = 1024.0 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return row


class GivenUp(Exception):
    """Steps took longer than a setting may; the CPU time [s]."""


def measured(simulation, frame):
    """What a setting's row has, after it has settled. Raises GivenUp."""
    start, end, longest = frame["measured_from"], frame["end"], frame["longest"]

    def within(spent):
        if spent > longest:
            raise GivenUp(spent)
        return spent

    within(talus._core._run_unobserved(simulation, start, 0.0, longest))
    findings = talus.Findings(simulation)
    began, unit, cpu = simulation.time, talus._core._study_units(simulation)["speed"], 0.0
    velocity_error = MeanAndError()
    for part in range(1, LOOKS + 1):
        velocity_error.add(findings.velocity_error() / unit)
        cpu = within(findings.run(start + part * (end - start) / LOOKS, cpu, longest))
    simulated = simulation.time - began or math.nan
    own = ("velocity_error", velocity_error.mean(), velocity_error.standard_error(), "sqrt(g d)")
    return {"cpu_s_per_s": cpu / simulated, "contact_updates_per_s": findings.contact_updates / simulated, "profile": findings.profile(),
            "findings": [dict(zip(("name", "value", "spread", "unit"), one)) for one in (own, *findings.results())]}
