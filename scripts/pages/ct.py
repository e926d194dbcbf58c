# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/ct.md, from ct.csv of bench/ct/run (one row per seed and recipe) and ct-large.csv of bench/ct/large
(one row)."""
from pages.data import minus, one, rows, table
from pages.marks import mark

DOCUMENT = "docs/ct.md"
LINES = (  # name, column, factor, digits, sign
    ("grains", "grains", 1, 0, False),
    ("found (IoU > 0.5) (%)", "found", 100, 1, False),
    ("wrong splits (%)", "wrong_splits", 100, 1, False),
    ("wrong merges (%)", "wrong_merges", 100, 1, False),
    ("median Dice", "dice_median", 1, 3, False),
    ("whole grains", "whole_grains", 1, 0, False),
    ("their voxels (%)", "voxel_volume_error", 100, 2, True),
    ("mean volume of the surfaces (%)", "volume_m3_mean_error", 100, 2, True),
    ("mean area (%)", "area_m2_mean_error", 100, 2, True),
    ("mean D^L (%)", "d_long_m_mean_error", 100, 2, True),
    ("mean D^I (%)", "d_intermediate_m_mean_error", 100, 2, True),
    ("mean D^S (%)", "d_short_m_mean_error", 100, 2, True),
    ("mean square mesh (%)", "sieve_m_mean_error", 100, 2, True),
    ("sieve class right, by D^I (%)", "class_right_d_intermediate", 100, 1, False),
    ("sieve class right, by the square mesh (%)", "class_right_sieve", 100, 1, False),
    ("air voids (points)", "air_voids_points_error", 1, 2, True),
    ("aggregate (points)", "aggregate_points_error", 1, 2, True),
)
COST = (
    ("edge of a voxel (µm)", "voxel_um", 1, 0, False),
    ("time with two threads (s)", "seconds", 1, 0, False),
    ("memory (GB)", "peak_mb", 1e-3, 2, False),
)


@mark
def ct(recipe):
    runs = [r for r in rows("ct.csv") if r["recipe"] == recipe]
    heads = [f"seed {r['seed']:g}" + (", projections" if r["faults"] == "projections" else ", noisy" if r["faults"] else "") for r in runs]
    lines = [[name, *(minus(f"{factor * r[column]:{'+' if sign else ''}.{digits}f}") for r in runs)]
             for name, column, factor, digits, sign in COST + LINES]
    return table(["", *heads], lines, range(1, len(heads) + 1))


LARGE = (  # name, column, factor, digits, sign
    ("voxels along each axis", "voxels_along", 1, 0, False),
    ("the file (GB)", "bytes", 1e-9, 1, False),
    ("memory that may be taken (GB)", "memory_gb", 1, 0, False),
    ("memory taken at most (GB)", "peak_bytes", 1e-9, 2, False),
    ("voxels along a block", "block", 1, 0, False),
    ("surfaces from the file", "refined", 1, 0, False),
    ("time beside other work (s)", "seconds", 1, 0, False),
    ("processor time (s)", "cpu_seconds", 1, 0, False),
) + tuple(line for line in LINES if line[1] in (
    "grains", "found", "wrong_splits", "wrong_merges", "dice_median", "volume_m3_mean_error", "area_m2_mean_error",
    "d_intermediate_m_mean_error", "air_voids_points_error", "aggregate_points_error"))


@mark
def large_scan():
    run = one(rows("ct-large.csv"))
    lines = [[name, minus(f"{factor * run[column]:{'+' if sign else ''}.{digits}f}")]
             for name, column, factor, digits, sign in LARGE]
    return table(["", "two levels"], lines, [1])


@mark
def large(what):
    return f"{one(rows('ct-large.csv'))[what]:g}"
