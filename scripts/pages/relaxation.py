# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/relaxation.md, from relaxation.csv (one row per scene) and relaxation-curves.csv of
bench/relaxation/run, and from stepped-loads.csv (one row per test) of bench/relaxation/stepped."""
from pages.data import one, power, rows, table, thousands, upto
from pages.marks import mark

DOCUMENT = "docs/relaxation.md"
DECADES = [10.0 ** k for k in range(-3, 5)]


def found(scene):
    return one(rows("relaxation.csv"), scene=scene)


@mark
def costs():
    lines = [[r["scene"], thousands(r["particles"]), f"{r['solutions']:.0f}", power(upto(r["error"])),
              power(upto(r["difference_from_harmonic"])), f"{r['units']:.0f}", power(upto(r["table_error"])),
              f"{r['wall_s']:.0f}", f"{r['cpu_s']:.0f}", f"{r['memory_gb']:g}"] for r in rows("relaxation.csv")]
    return table(["scene", "particles", "solutions", "error of E(t)", "from the harmonic solver", "units of the tables",
                  "their error", "wall (s)", "processor time (s)", "memory (GB)"], lines, range(1, 10))


@mark
def moduli():
    def at(scene, t):
        return next(r for r in rows("relaxation-curves.csv") if r["scene"] == scene and abs(r["time_s"] / t - 1) < 1e-6)

    scenes = [r["scene"] for r in rows("relaxation.csv")]
    lines = [[f"{t:g}", *(x for s in scenes for x in (f"{1e-6 * at(s, t)['modulus_pa']:.4g}",
                                                      f"{1e9 * at(s, t)['compliance_1_pa']:.4g}"))] for t in DECADES]
    return table(["t (s)", *(x for s in scenes for x in (f"{s}: E(t) (MPa)", "J(t) (1/GPa)"))], lines,
                 range(2 * len(scenes) + 1))


@mark
def stepped():
    lines = [[r["kind"], thousands(r["density_scaling"]), thousands(r["steps"]), power(upto(r["difference"])),
              power(upto(r["error"])), power(upto(r["kinetic_share"])), f"{r['wall_s']:.1f}"]
             for r in rows("stepped-loads.csv")]
    return table(["kind", "density scaling", "steps", "from the test without a step", "`error`", "`kinetic_share`",
                  "wall (s)"], lines, range(1, 7))


@mark
def stepped_particles():
    return thousands(rows("stepped-loads.csv")[0]["particles"])


@mark
def seconds(scene):
    return f"{found(scene)['wall_s']:.0f} s"


@mark
def threads():
    return f"{rows('relaxation.csv')[0]['threads']:.0f}"


@mark
def error(scene):
    return power(upto(max(found(scene)["error"], found(scene)["difference_from_harmonic"])))
