# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases of the validation page, in its order."""

CASES = ("beverloo", "discharge", "conical_hopper", "clogging", "janssen", "repose", "column_collapse", "drum", "incline",
         "plane_shear", "packings", "force_distribution", "granular_gas", "crater", "chung_ooi", "segregation",
         "round_robin", "same_scene", "cohesion")
