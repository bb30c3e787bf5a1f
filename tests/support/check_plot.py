#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that postprocess/plot_metrics.py knows the units of all columns and draws vectors in one panel.

    tests/support/check_plot.py

Exit codes: 0 it does, 1 it does not.
"""
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postprocess"))
import plot_metrics  # noqa: E402  found by the line above
from read_run import Run  # noqa: E402

COLUMNS = ["time_s", "spheres", "lid_force_x_N", "lid_force_y_N", "lid_force_z_N", "lid_torque_x_N_m", "lid_speed_m_per_s",
           "lid_travel_m", "bed_stress_xx_Pa", "bed_stress_yz_Pa", "bed_granular_temperature_m2_per_s2",
           "bed_packing_fraction", "out_passed_mass_kg", "out_mass_flow_kg_per_s", "heap_angle_deg",
           "heap_spin_x_rad_per_s"]
PANELS = [("lid force", "N", "xyz"), ("lid torque", "N m", "x"), ("lid speed", "m/s", ["lid speed"]),
          ("lid travel", "m", ["lid travel"]), ("bed stress", "Pa", ["xx", "yz"]),
          ("bed granular temperature", "m²/s²", ["bed granular temperature"]),
          ("bed packing fraction", "number", ["bed packing fraction"]), ("out passed mass", "kg", ["out passed mass"]),
          ("out mass flow", "kg/s", ["out mass flow"]), ("heap angle", "degrees", ["heap angle"]), ("heap spin", "rad/s", "x")]


def main():
    with tempfile.TemporaryDirectory() as folder:
        sensors = "".join(f'[[sensor]]\nname = "{name}"\n' for name in ["lid", "bed", "out", "heap"])
        (Path(folder) / "scene.resolved.toml").write_text(sensors)
        rows = [",".join(str(float(k + j)) for j in range(len(COLUMNS))) for k in range(3)]
        (Path(folder) / "metrics.csv").write_text("\n".join([",".join(COLUMNS), *rows]) + "\n")
        run = Run(folder)
        panels = [(title, unit, list(curves.values()))
                  for title, unit, _, curves in plot_metrics.sensor_panels(run, run.metrics())]
        plot_metrics.draw(run).savefig(Path(folder) / "metrics.png")
    wanted = [(title, unit, list(curves)) for title, unit, curves in PANELS]
    for got, want in zip(panels, wanted):
        if got != want:
            print(f"check_plot.py: {got} is drawn in place of {want}", file=sys.stderr)
    sys.exit(0 if panels == wanted else 1)


if __name__ == "__main__":
    main()
