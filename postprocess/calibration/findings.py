# SPDX-License-Identifier: GPL-3.0-or-later
"""What a calibration found, from the runs of its sweeps."""
from dataclasses import dataclass

import numpy

from calibration.emulator import Emulator, shares
from calibration.posterior import Posterior, posterior
from read_run import RunError
from sweeps.results import quantities_of, setting

UNLIKELY = 0.01  # a misfit that so few measurements would have by chance


@dataclass
class Findings:
    target: object
    emulators: list  # one for each measurement
    units: list
    dropped: dict  # by scene: cases without a result
    posterior: Posterior

    def value(self, k, share):
        """The value of the unknown key number k at a share of its range, which may be a list of them."""
        one = list(self.target.unknown.values())[k]
        return one.low * (one.high / one.low) ** numpy.asarray(share) if one.log else one.low + numpy.asarray(share) * (one.high - one.low)

    def told(self, places):
        """What each measurement would give at some places: a list of values and errors, without the scatter of a run."""
        return [emulator.tell(places) for emulator in self.emulators]

    def chance(self):
        """How likely measurements that agree with the scenes would have a misfit as large."""
        from scipy.stats import chi2

        return float(chi2.sf(self.posterior.misfit, len(self.target.measured)))

    def as_dictionary(self):
        """For calibration.json."""
        keys, best = {}, self.posterior.best
        for k, key in enumerate(self.target.unknown):
            median, low, high = (float(f"{self.value(k, share):.6g}") for share in self.posterior.interval(k))
            keys[key] = {"best": float(f"{self.value(k, best[k]):.6g}"), "median": median, "interval_95": [low, high]}
        measured = [{"scene": one.scene, "quantity": f"{one.sensor}.{one.name}", "unit": unit, "value": one.value, "error": one.error,
                     "best": float(f"{mean[0]:.6g}"), "emulator_error": float(f"{error[0]:.6g}"), "scatter": float(f"{emulator.scatter:.6g}")}
                    for one, unit, emulator, (mean, error) in zip(self.target.measured, self.units, self.emulators, self.told(best[None, :]))]
        correlation = numpy.atleast_2d(numpy.corrcoef(self.posterior.places.T)) if len(keys) > 1 else numpy.eye(1)
        return {"unknown": keys, "measured": measured, "chance_of_misfit": float(f"{self.chance():.3g}"),
                "correlation": [[round(float(one), 3) for one in row] for row in correlation]}


def find(target, cases_by_scene):
    """The Findings of a target, from the cases of its sweeps by name.

    Raises RunError where there are too few results, or a scene has no such sensor.
    """
    emulators, units, dropped = [], [], {}
    for one in target.measured:
        cases, varied = cases_by_scene[one.scene], target.sweeps[one.scene].vary
        unit, used, values = values_of(one, cases)
        dropped[one.scene] = len(cases) - len(used)
        if len(used) < 4 * len(varied) + 2:
            raise RunError(f"{one.title} of {one.scene}: {len(used)} of {len(cases)} cases have it, too few to learn from; "
                           f"{4 * len(varied) + 2} are needed for {len(varied)} unknown keys.")
        places = shares(varied.values(), [[setting(case.settings[key]) for key in varied] for case in used])
        emulators.append(Emulator(places, values, [list(target.unknown).index(key) for key in varied]))
        units.append(unit)
    return Findings(target, emulators, units, dropped, posterior(target.measured, emulators, len(target.unknown)))


def values_of(one, cases):
    """The unit of what was measured, the cases that found it, and what they found."""
    units = quantities_of(cases)
    if units and (one.sensor, one.name) not in units:
        known = ", ".join(f"{sensor}.{name}" for sensor, name in units) or "none"
        raise RunError(f"The scene '{one.scene}' finds no {one.sensor}.{one.name}; it finds {known}.")
    unit = units.get((one.sensor, one.name), "")
    if one.unit and unit and one.unit != unit:
        raise RunError(f"{one.sensor}.{one.name} of the scene '{one.scene}' is in {unit}, not in {one.unit}.")
    used = [case for case in cases if case.quantities().get((one.sensor, one.name), {}).get("value") is not None]
    return unit, used, [case.quantities()[one.sensor, one.name]["value"] for case in used]
