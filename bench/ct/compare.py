#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares a segmentation with the truth of a phantom. Prints `name value` lines, or CSV with --csv.

    bench/ct/compare.py DIR TRUTH [--above 4e-3] [--csv]

DIR holds labels.mha, phases.mha and grains.csv of `macadam ct segment`, TRUTH those of `macadam ct phantom`. Only
grains count whose true volume is at least that of a sphere of diameter --above [m]. A grain is found if its overlap
with one label is more than half of their union. It is wrongly split if two or more labels each contain a tenth of
it. A label is a wrong merge if two or more true grains each make up a tenth of it. Both are given relative to the
number of true grains. Volumes, sieve classes and measures are of grains that were found and that the border does
not cut. Needs Debian's python3-numpy."""
import argparse
import csv
import zlib
from pathlib import Path

import numpy as np

TYPES = {"MET_UCHAR": "<u1", "MET_USHORT": "<u2", "MET_UINT": "<u4", "MET_FLOAT": "<f4"}
MEASURES = ("volume_m3", "area_m2", "d_long_m", "d_intermediate_m", "d_short_m", "sphericity", "sieve_m")
SIEVES = np.array([0, 0.5, 1, 2, 4, 6.3, 10, 12.5, 16, 20]) * 1e-3  # same sieves as in `macadam ct segment`


def read_mha(file):
    """Returns the voxels as an array with axes z, y, x, and the volume of a voxel [m³]."""
    raw = Path(file).read_bytes()
    head, at = {}, 0
    while "ElementDataFile" not in head:
        end = raw.index(b"\n", at)
        key, value = raw[at:end].decode().split("=", 1)
        head[key.strip()], at = value.strip(), end + 1
    data = raw[at:]
    if head.get("CompressedData", "False") == "True":
        data = zlib.decompress(data)
    size = [int(n) for n in head["DimSize"].split()]
    spacing = [float(n) * 1e-3 for n in head["ElementSpacing"].split()]
    return np.frombuffer(data, TYPES[head["ElementType"]]).reshape(size[::-1]), np.prod(spacing)


def read_grains(file):
    if not Path(file).exists():
        return {}
    with open(file, encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    return {int(row["id"]): {name: float(row[name]) for name in MEASURES if name in row} for row in rows}


def pairs(truth, labels):
    """Returns the number of voxels that each true grain shares with each label: {(grain, label): count}."""
    both = truth.astype(np.uint64) << np.uint64(32) | labels.astype(np.uint64)
    keys, counts = np.unique(both, return_counts=True)
    return {(int(k >> np.uint64(32)), int(k & np.uint64(0xFFFFFFFF))): int(n) for k, n in zip(keys, counts)}


def at_border(labels, phases):
    """Returns the labels that touch the end of the image or voxels outside the specimen."""
    found = set()
    for axis in range(3):
        for end in (0, -1):
            found |= set(np.unique(np.take(labels, end, axis)))
        for shift in (1, -1):
            beside = np.roll(phases, shift, axis) == 255
            found |= set(np.unique(labels[beside]))
    return found


def compare(folder, truth_folder, above):
    labels, voxel = read_mha(folder / "labels.mha")
    truth, _ = read_mha(truth_folder / "labels.mha")
    phases, _ = read_mha(folder / "phases.mha")
    true_phases, _ = read_mha(truth_folder / "phases.mha")
    grains, true_grains = read_grains(folder / "grains.csv"), read_grains(truth_folder / "grains.csv")
    shared = pairs(truth, labels)
    in_truth, in_label, of_truth, of_label = {}, {}, {}, {}
    for (t, n), count in shared.items():
        in_truth[t] = in_truth.get(t, 0) + count
        in_label[n] = in_label.get(n, 0) + count
        if t and n:
            of_truth.setdefault(t, {})[n] = count
            of_label.setdefault(n, {})[t] = count
    least = np.pi / 6 * above**3 / voxel
    wanted = [t for t in in_truth if t and in_truth[t] >= least]
    border = at_border(truth, true_phases)
    found, dice, splits, mergers = {}, [], 0, set()
    for t in wanted:
        parts = of_truth.get(t, {})
        best = max(parts, key=parts.get, default=0)
        if best:
            union = in_truth[t] + in_label[best] - parts[best]
            dice.append(2 * parts[best] / (in_truth[t] + in_label[best]))
            if parts[best] > 0.5 * union:
                found[t] = best
        else:
            dice.append(0.0)
        splits += sum(n >= 0.1 * in_truth[t] for n in parts.values()) > 1
    for n, parts in of_label.items():
        large = [t for t in parts if in_truth[t] >= least and parts[t] >= 0.1 * in_label[n]]
        if len(large) > 1:
            mergers.add(n)
    out = {
        "grains": len(wanted),
        "found": len(found) / len(wanted),
        "wrong_splits": splits / len(wanted),
        "wrong_merges": len(mergers) / len(wanted),
        "dice_median": float(np.median(dice)),
    }
    whole = [t for t in found if t not in border]
    errors = [in_label[found[t]] / in_truth[t] - 1 for t in whole]
    out["whole_grains"] = len(whole)
    out["voxel_volume_error"] = sum(in_label[found[t]] for t in whole) / sum(in_truth[t] for t in whole) - 1 if whole else np.nan
    out["voxel_volume_error_median"] = float(np.median(np.abs(errors))) if whole else np.nan
    both = [(true_grains[t], grains[found[t]]) for t in whole if t in true_grains and found[t] in grains]
    if both:
        for name in MEASURES:
            pair = np.array([(a[name], b[name]) for a, b in both if np.isfinite(a.get(name, np.nan))])
            if len(pair):
                out[f"{name}_mean_error"] = pair[:, 1].mean() / pair[:, 0].mean() - 1
        for key in ("d_intermediate_m", "sieve_m"):
            known = [(a[key], b[key]) for a, b in both if np.isfinite(a.get(key, np.nan))]
            same = [np.searchsorted(SIEVES, a, "right") == np.searchsorted(SIEVES, b, "right") for a, b in known]
            if same:
                out[f"class_right_{key.rsplit('_', 1)[0]}"] = float(np.mean(same))
    specimen = true_phases != 255
    for name, phase in (("air_voids", 0), ("aggregate", 2)):
        out[f"{name}_true"] = float((true_phases[specimen] == phase).mean())
        out[f"{name}_points_error"] = 100 * (float((phases[phases != 255] == phase).mean()) - out[f"{name}_true"])
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("truth", type=Path)
    parser.add_argument("--above", type=float, default=4e-3)
    parser.add_argument("--csv", action="store_true")
    arguments = parser.parse_args()
    out = compare(arguments.folder, arguments.truth, arguments.above)
    if arguments.csv:
        print(",".join(out))
        print(",".join(f"{v:.6g}" for v in out.values()))
    else:
        for name, value in out.items():
            print(f"{name:<32} {value:.5g}")


if __name__ == "__main__":
    main()
