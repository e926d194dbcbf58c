# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of bench/README.md."""
import csv
import math

from pages import bench_command
from pages.data import head, one, opened, rows, span, table, text
from pages.marks import mark

DOCUMENT = "bench/README.md"
PARTS = (bench_command,)  # modules with more marks of this document
GPU = "gpu-step-h200-2026-11-23.csv"


def cpu_rows():
    """Returns the rows of `macadam bench` on a processor."""
    found = []
    for r in rows("bench-cpu-2026-11-23.csv"):
        _, _, _, form, precision, geometry, threads = r["row"].split("/")
        found.append({"form": form, "precision": precision, "geometry": geometry, "threads": threads.split(":")[1],
                      "ms": r["us"] / 1e3, "bytes": r["bytes_per_contact"], "contacts": r["contacts"] / r["us"],
                      "share": r["memory_share"]})
    return found


@mark
def cpu_machine():
    first = rows("bench-cpu-2026-11-23.csv")[0]
    return f"{head('bench-cpu-2026-11-23.csv')[0]}, copy {first['copy_bytes_per_s'] / 1e9:.0f} GB/s"


@mark
def cpu():
    return table(["form", "precision", "geometry", "threads", "ms per step", "bytes per contact", "10⁶ contacts/s",
                  "share of copy"],
                 [(r["form"], r["precision"], r["geometry"], r["threads"], f"{r['ms']:.1f}", f"{r['bytes']:.0f}",
                   f"{r['contacts']:.1f}", f"{r['share']:.2f}") for r in cpu_rows()])


MORE_CORES = "bench-cpu-16-cores-2026-11-25.csv"


@mark
def more_cores_machine():
    return head(MORE_CORES)[0]


@mark
def more_cores():
    """Returns the table of times per step over the number of threads, for fixed geometry."""
    threads = (1, 2, 4, 8, 16)
    lines = []
    for precision in ("single", "mixed", "double"):
        us_of = [one(rows(MORE_CORES), row=f"step/ac14_ss_am1/cpu/condensed/{precision}/fixed/threads:{n}")["us"] for n in threads]
        lines.append((precision, *(f"{us / 1e3:.2f}" for us in us_of), f"{us_of[0] / us_of[-1]:.1f}"))
    return table(["ms per step by number of threads", *map(str, threads), "one to sixteen"], lines)


@mark
def two_thread_shares():
    return span([r["share"] for r in cpu_rows() if r["threads"] == "2"], "{:.1f}", " to ")


# Yields (condensed, points) of rows with the same settings.
def pairs(threads=None):
    for r in cpu_rows():
        if r["form"] == "condensed" and threads in (None, r["threads"]):
            yield r, one(cpu_rows(), form="points", **{k: r[k] for k in ("precision", "geometry", "threads")})


@mark
def fewer_bytes():
    return span([p["bytes"] / c["bytes"] for c, p in pairs()], "{:.1f}", "–")


@mark
def condensed_faster():
    return span([p["ms"] / c["ms"] for c, p in pairs()], "{:.1f}", "–")


def step(name, geometry):
    found = [r for r in rows(GPU) if r["step"] == f"{name}/{geometry}"]
    return found[0] if found else None


def us(row):
    return "" if row is None else f"{row['us']:.1f}" if row["us"] < 50 else f"{row['us']:,.0f}"


STEPS = [  # name in the benchmark, name in the table, target time [µs]
    ("full/condensed/single", "full specimen, condensed, single", "6.0"),
    ("full/condensed/mixed", "… mixed", "6.3"),
    ("full, elastic/condensed/mixed", "… mixed, all contacts elastic", "5.5"),
    ("full/condensed/double", "… double", "45"),
    *((f"full, {n} units/condensed/double", f"… double, {n} Kelvin units", "") for n in (0, 1, 2, 4, 5, 6)),
    ("full/points/double", "full specimen, points, double", "125"),
    ("ico fine/condensed/single", "MS-Ico-fine, 63,883 / 441,000 contacts, single", "22"),
    ("ico fine/condensed/mixed", "… mixed", "25"),
    ("ico fine/condensed/double", "… double", ""),
    ("fcc 1e5/condensed/single", "fcc 10⁵ / 5.7·10⁵, single", "50"),
    ("fcc 1e5/condensed/mixed", "… mixed", "53"),
    ("fcc 1e6/condensed/single", "fcc 10⁶ / 5.9·10⁶, single", "560"),
    ("fcc 1e6/condensed/mixed", "… mixed", "620"),
    ("fcc 1e6/condensed/double", "… double", ""),
    ("fcc 1e7/condensed/single", "fcc 10⁷ / 6·10⁷, single", "6,200"),
]


def in_plain_words(text):
    """Returns a text of a committed table with the terms of today's pages."""
    return (text.replace("tiles on the chip", "resident tiles").replace("settling", "state update")
            .replace("two kernels a step", "two kernels"))


def judged(bar, measured):
    """Returns the target time, and whether the measured time misses it."""
    if not bar:
        return ""
    return bar if measured["us"] <= float(bar.replace(",", "")) else f"{bar}: missed"


@mark
def gpu():
    lines = []
    for name, label, bar in STEPS:
        fixed, updated = step(name, "fixed"), step(name, "updated")
        lines.append((label, us(fixed), us(updated), in_plain_words(fixed["path"].split(", ")[2]), judged(bar, fixed)))
    return table(["step", "µs fixed", "µs updated", "path", "target (fixed)"], lines)


@mark
def gpu_machine():
    return head(GPU)[0]


@mark
def held():
    names = [("full/condensed/single", "condensed, single"), ("full/condensed/mixed", "condensed, mixed"),
             ("full/condensed/double", "condensed, double"), ("full/points/double", "points, double")]
    return table(["", "fixed", "updated"], [(label, *(f"{step(name, g)['held_bytes_per_contact']:,.0f}"
                                                      for g in ("fixed", "updated"))) for name, label in names])


@mark
def share_of_copy():
    """Returns the numbers of steps that run as two kernels, on the full specimen with AM1."""
    of = [r["share_of_copy"] for r in rows(GPU) if r["step"].startswith("full/") and "two kernels" in r["path"]]
    return f"{min(of):.2f} to {max(of):.2f}"


@mark
def double_bytes():
    return f"{step('full/condensed/double', 'fixed')['bytes_per_contact']:.0f}"


@mark
def double_share():
    return f"{step('full/condensed/double', 'fixed')['share_of_copy']:.2f}"


def tried(name, *columns):
    """Returns columns of a table as the texts in the file."""
    with opened(name) as f:
        return [tuple(r[c] for c in columns) for r in csv.DictReader(line for line in f if not line.startswith("#"))]


@mark
def tried_cpu():
    return table(["design", "ms"], tried("tried-cpu-step.csv", "design", "ms"))


@mark
def tried_gpu():
    return table(["design", "µs"], tried("tried-gpu-step.csv", "design", "us"))


@mark
def blocks():
    return table(["", "mixed", "single"], tried("tried-gpu-blocks.csv", "case", "mixed", "single"))


@mark
def block_setting():
    return head("tried-gpu-blocks.csv")[0]


# ---- rows of macadam bench

BENCH = "bench-h200-2026-11-23.csv"
AXES = "bench-h200-2026-11-25-axes.csv"
TEAM = "team-h200-2026-11-23.csv"


@mark
def bench_machine():
    return head(BENCH)[0]


@mark
def parts():
    """Returns the table of times of the parts of a step, on one device."""
    cases = [(TEAM, "ac14_ss_am1", p, label) for p, label in (("single", "full specimen, single"), ("mixed", "… mixed"), ("double", "… double"))]
    cases += [(TEAM, "ac14_ms_ico_fine", p, label) for p, label in (("mixed", "MS-Ico-fine, mixed"), ("double", "… double"))]
    cases += [(BENCH, "lattice:1e6", p, label) for p, label in (("single", "lattice of 10⁶, single"), ("double", "… double"))]
    lines = []
    for file, scene, precision, label in cases:
        r = one(rows(file), row=f"step/{scene}/cuda/condensed/{precision}/fixed")
        share = [f"{name} {r[f'{name}_share']:.2f}" for name in ("memory", "cache", "shared") if r[f"{name}_share"]]
        lines.append((label, us(r), in_plain_words(r["parts"]), ", ".join(share)))
    return table(["step, geometry fixed", "µs", "parts (µs)", "share of bandwidth"], lines)


@mark
def multiprocessors():
    numbers = (132, 84, 46, 28)
    lines = []
    for scene, label in (("ac14_ss_am1", "full specimen, mixed"), ("lattice:1e5", "lattice of 10⁵, mixed")):
        found = [one(rows(AXES), row=f"step/{scene}/cuda/condensed/mixed/fixed/multiprocessors:{n}") for n in numbers]
        lines.append((label, *(f"{us(r)}{'' if 'chip' in r['path'] else ' (streamed)'}" for r in found)))
    return table(["µs per step by number of multiprocessors", *map(str, numbers)], lines)


CHIP = "bench-h200-2026-11-26-chip.csv"
@mark
def chip_machine():
    return head(CHIP)[0]


@mark
def chip_steps():
    """Returns the table of times of steps over tiles, measured again after a change of the program."""
    scenes = {"ac14_ss_am1": "full specimen", "ac14_ms_ico_fine": "MS-Ico-fine",
              **{f"lattice:1e{n}": f"lattice of 10{power}" for n, power in ((3, "³"), (5, "⁵"), (6, "⁶"))}}
    lines = []
    for r in rows(CHIP):
        kind, scene, *_, precision, geometry = r["row"].split("/")
        label = f"{scenes[scene]}, {precision}, geometry {geometry}"
        if kind == "elastic step":
            label += ", all contacts elastic"
        lines.append((label, us(r), in_plain_words(r["parts"])))
    return table(["step", "µs", "parts (µs)"], lines)


# ---- length of blocks

BLOCKS = "block-lengths.csv"


@mark
def block_cases():
    return str(len({tuple(r[c] for c in ("binder", "hz", "cycles", "particles", "steps_per_period")) for r in rows(BLOCKS)}))


@mark
def block_worst():
    return f"{max(r['over_envelope'] for r in rows(BLOCKS)):.2f}"


@mark
def block_lengths():
    out = []
    for n in sorted({r["blocks"] for r in rows(BLOCKS)}, reverse=True):
        of = [r for r in rows(BLOCKS) if r["blocks"] == n]
        out.append((f"{n:,.0f}", f"{max(abs(r['e_star']) for r in of):.1e}", f"{max(abs(r['phase_rad']) for r in of):.1e}",
                    f"{(2 * math.pi / n)**2 / 20:.1e}"))
    return table(["N", "error of \\|E\\*\\|, at most", "of φ (rad), at most", "counted with"], out)


BLOCK_ROUNDING = "block-precision.csv"


@mark
def block_rounding_machine():
    return ", ".join(head(BLOCK_ROUNDING)[0].split("; ")[:2])


@mark
def block_rounding():
    out = []
    for r in rows(BLOCK_ROUNDING):
        out.append((r["backend"], r["precision"], f"{r['steps']:,.0f}", f"{r['e_star']:.1e}", f"{r['phase_rad']:.1e}"))
    return table(["backend", "precision", "steps of a block", "error of \\|E\\*\\|", "of φ (rad)"], out, right=(2, 3, 4))


# ---- one command to a result on the GPU

def command():
    return {r["quantity"]: r["value"] for r in rows("gpu-command.csv")}


@mark
def command_machine():
    return head("gpu-command.csv")[0]


@mark
def command_time(what):
    return f"{command()[what]:.1f} s"


@mark
def whole_steps():
    of = [r for r in rows("whole-tests-h200-2026-11-23.csv") if r["scene"].startswith("tolerance")]
    return f"{sum(r['steps'] for r in of):,.0f} steps, {sum(r['stepping_s'] for r in of):.1f} s"


@mark
def placement():
    return [f"    {line}" for line in text("placement.txt") if line.strip()]


@mark
def placement_machine():
    return head("placement.txt")[0]


# ---- what comes before the first step

PREPARATION, BY_ONE_THREAD = "preparation-h100-2026-11-26.csv", "preparation-h200-2026-11-23.csv"


@mark
def preparation_machine():
    return head(PREPARATION)[0]


def preparation_of(table, scene):
    """Returns the row of a scene, and the seconds of each part of the preparation."""
    r = one(rows(table), row=f"preparation/{scene}/cuda/condensed/mixed/fixed")
    return r, {name: float(us) / 1e6 for name, us in (part.rsplit(" ", 1) for part in r["parts"].split(", "))}


@mark
def preparation_before():
    """Returns the time of a tessellation of 10⁷ particles with a triangulation by one thread, and the machine."""
    return f"{preparation_of(BY_ONE_THREAD, 'lattice:1e7')[1]['tessellation']:.0f} s ({head(BY_ONE_THREAD)[0]})"


@mark
def preparation():
    lines = []
    for scene, label in (("ac14_ss_am1", "full specimen"), ("lattice:1e6", "lattice of 10⁶"), ("lattice:1e7", "lattice of 10⁷")):
        r, parts = preparation_of(PREPARATION, scene)
        lines.append((f"{label}, {r['contacts']:,.0f} contacts", f"{r['us'] / 1e6:.3g}",
                      *(f"{parts[name]:.2g}" for name in ("tessellation", "network", "critical step", "stepper"))))
    return table(["seconds, 16 cores", "all", "tessellation", "contacts", "critical step", "arrays on the GPU"], lines)


# ---- other programs

PEERS = "peers.csv"


@mark
def peers_machine():
    return head(PEERS)[0]


@mark
def peers():
    lines = []
    for r in rows(PEERS):
        lines.append((r["program"], r["settings"], f"{r['threads']:.0f}", f"{r['bonds']:,.0f}", f"{r['ms_a_step']:.1f}",
                      f"{1e3 * r['us_a_bond_and_core']:.0f}"))
    return table(["program", "settings", "threads", "bonds", "ms per step", "ns per bond and core"], lines)


@mark
def peers_factors():
    """Returns the ratio of other programs' times to Macadam's on one thread, with the precision and geometry that all
    have."""
    of = {r["program"]: r["ms_a_step"] for r in rows(PEERS) if r["threads"] == 1 and r["settings"] == "double, geometry updated"}
    return " and ".join(f"{ms / of['Macadam']:.2g} ({name})" for name, ms in of.items() if name != "Macadam")
