# SPDX-License-Identifier: GPL-3.0-or-later
"""A box of beads under a lid, as a dict."""


def box_of_beads(**changes):
    scene = {
        "title": "Beads in a box",
        "time": {"duration": 0.3, "frame_interval": 0.1, "metrics_interval": 0.02},
        "materials": {"glass": {"density": 2500.0}},
        "contact": [{"between": ["glass", "glass"], "friction": 0.5, "restitution": 0.3}],
        "fill": [{"material": "glass", "count": 120,
                  "diameter": {"distribution": "uniform", "min": 0.009, "max": 0.011},
                  "region": {"shape": "box", "min": [0, 0, 0], "max": [0.05, 0.05, 0.18]}}],
        "wall": [{"name": "box", "shape": "box", "min": [0, 0, 0], "max": [0.05, 0.05, 0.2], "open": ["z+"],
                  "material": "glass"}],
        "sensor": [{"name": "on_box", "kind": "wall_force", "wall": "box", "from": 0.2}],
    }
    return scene | changes
