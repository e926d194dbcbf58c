# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/devices.md and docs/several-gpus.md: one specimen on several GPUs, several specimens on one GPU or more."""
from pages.data import head, one, rows, span, table
from pages.marks import mark

DOCUMENT = "docs/devices.md"
TEAM = "team-h100-2026-11-24.csv"


@mark
def team_machine():
    return head(TEAM)[0]


def pair(row):
    return one(rows(TEAM), row=row)["us"], one(rows(TEAM), row=f"{row}/devices:2")["us"]


def written(us):
    return f"{us:.1f}" if us < 1e3 else f"{us:,.0f}" if us < 1e5 else f"{us / 1e6:.2f} s"


SCENES = (("ac14_ss_am1", "full specimen, 221,000 contacts"), ("ac14_ms_ico_fine", "MS-Ico-fine, 441,000 contacts"),
          ("lattice:1e6", "lattice of 10⁶, 5.9·10⁶ contacts"))


@mark
def team():
    cases = [(f"step/{scene}/cuda/condensed/{p}/fixed", f"{label}, {p}")
             for scene, label in SCENES for p in ("single", "mixed", "double")]
    lines = []
    for row, label in cases:
        alone, both = pair(row)
        path = one(rows(TEAM), row=f"{row}/devices:2")["path"].split(", ")[2].replace("tiles on the chip", "resident tiles").replace(" a step", "")
        lines.append((label, written(alone), written(both), f"{alone / both:.2f}", path))
    return table(["time of a step (µs)", "one GPU", "two GPUs", "factor", "on two"], lines)


TEAM_HARMONIC = "team-harmonic-h200-2026-11-27.csv"


@mark
def team_harmonic_machine():
    return "two NVIDIA" + head(TEAM_HARMONIC)[0].split("two NVIDIA")[1].split(";")[0]


@mark
def team_harmonic(loads):
    row = f"harmonic/lattice:1e6/cuda/loads:{loads}"
    alone, both = (one(rows(TEAM_HARMONIC), row=row + more)["us"] for more in ("", "/devices:2"))
    return f"{alone / 1e6:.2f} s on one GPU and {both / 1e6:.2f} s on two, {alone / both:.2f} times as fast"


@mark
def team_huge():
    """Returns the times of twice the particles on two GPUs and of the particles on one."""
    alone = one(rows(TEAM), row="step/lattice:8e6/cuda/condensed/single/fixed")["us"]
    both = one(rows(TEAM), row="step/lattice:1.6e7/cuda/condensed/single/fixed/devices:2")["us"]
    return f"{both / 1e3:.2f} ms, and of half of it on one {alone / 1e3:.2f} ms: {100 * alone / both:.0f} %"


RANKS = "ranks-h100-2026-11-25.csv"


@mark
def ranks_machine():
    return head(RANKS)[0]


@mark
def ranks():
    lines = []
    for scene, label in SCENES:
        for p in ("single", "mixed", "double"):
            row = f"step/{scene}/cuda/condensed/{p}/fixed"
            alone, processes, memory = (one(rows(RANKS), row=row + more)["us"] for more in ("", "/ranks:2", "/devices:2"))
            lines.append((f"{label}, {p}", written(alone), written(processes), f"{alone / processes:.2f}", written(memory)))
    return table(["time of a step (µs)", "one GPU", "two processes, a GPU each", "factor", "one process, both GPUs"], lines)


MANY = "many.csv"


@mark
def many_machine():
    last = rows(MANY)[-1]
    return f"two {last['gpu']} of one host, 32 cores, {last['date']}, commit {last['commit']}"


def many_rows(tried=True):
    """Returns the mean times by number of GPUs of each version of the program, in the order of the rows: the first is
    the program before the changes, the last the current one. tried: include versions that were tried and not kept."""
    out = {}
    for r in rows(MANY):
        if not tried and r["how"].startswith("tried: "):
            continue
        out.setdefault(r["commit"], {}).setdefault(r["devices"], []).append(r["seconds"])
    return [{devices: sum(seconds) / len(seconds) for devices, seconds in times.items()} for times in out.values()]


@mark
def many(program):
    """Returns the times on one GPU and on two, of the program `before` the changes or `now`."""
    found = many_rows()[{"before": 0, "now": -1}[program]]
    return f"{found[1]:.1f} s on one GPU and {found[2]:.1f} s on two"


@mark
def many_factors():
    """Returns the range of the speed-up by a second GPU, of all versions after the first."""
    return span([times[1] / times[2] for times in many_rows(tried=False)[1:]], "{:.2f}", " to ")


@mark
def many_factor():
    """Returns the speed-up by a second GPU, of the current program."""
    times = many_rows()[-1]
    return f"{times[1] / times[2]:.2f}"


def courses(devices):
    """Returns a list for each run on this number of GPUs, with one row per GPU."""
    runs = {}
    for r in rows("many-course.csv"):
        if r["devices"] == devices:
            runs.setdefault(r["run"], []).append(r)
    return list(runs.values())


def of_one_gpu():
    """Returns the seconds on one GPU before the first steps, for each specimen, and after the last steps."""
    ((r,),) = courses(1)
    return r["first_steps_s"], (r["last_steps_s"] - r["first_steps_s"]) / r["specimens"], r["process_s"] - r["last_steps_s"]


@mark
def many_step(devices):
    """Returns the range of the mean time per step of each GPU, from its first step to its last one [µs]."""
    return span([1e6 * (r["last_steps_s"] - r["first_steps_s"]) / r["steps"] for run in courses(int(devices)) for r in run], "{:.1f}", " to ")


@mark
def many_idle():
    """Returns the range of the idle times of two GPUs between their first and last steps."""
    return span([r["idle_s"] for run in courses(2) for r in run], "{:.1f}", " to ")


@mark
def many_parts(part):
    return f"{of_one_gpu()[['first', 'specimen', 'end'].index(part)]:.1f} s"


@mark
def many_limit():
    """Returns the speed-up by a second GPU for twenty specimens that would result if both GPUs began and ended at the
    same time."""
    first, specimen, end = of_one_gpu()
    return f"{(first + 20 * specimen + end) / (first + 10 * specimen + end):.2f}"


@mark
def many_apart(part):
    """Returns the largest difference between the times at which two GPUs begin or end."""
    column = {"begin": "first_steps_s", "end": "last_steps_s"}[part]
    return f"{max(abs(a[column] - b[column]) for a, b in courses(2)):.1f} s"


@mark
def many_worst():
    """Returns the largest times with one GPU and with two, of all versions after the first."""
    one_gpu, two = (max(times[n] for times in many_rows()[1:]) for n in (1, 2))
    return f"{one_gpu:.0f} s and {two:.0f} s"
