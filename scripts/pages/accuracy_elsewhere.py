# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/verification.md with numbers that other programs measured or assert: runs on a GPU, tests, the paper's
specimens."""
from pages import common, verification
from pages.accuracy_rows import both, signed
from pages.data import head, listed, mean, minus, one, percents, plain, power, rows, table, thousands, upto, where
from pages.marks import mark

WHOLE = "whole-tests-h200-2026-11-23.csv"


@mark
def whole_tests():
    return table(["f (Hz)", "settings", "density scaling", "steps", "stepping (s)", "\\|E\\*\\|", "φ (rad)"],
                 [(f"{r['frequency_hz']:g}", f"{r['scene']}; {r['precision']}, {r['geometry']}",
                   f"{r['density_scaling']:,.0f}", thousands(r["steps"]), plain(r["stepping_s"], 2),
                   signed(r["error_e_star"]), signed(r["error_phase_rad"]))
                  for r in rows(WHOLE)])


@mark
def whole_command(scene, frequency):
    """Returns the time from the start of the command to its end."""
    of = one(rows(WHOLE), scene=scene.replace("_", " "), frequency_hz=float(frequency), geometry="fixed")
    return f"{of['command_s']:.1f} s"


GPU_TESTS = "gpu-tests-h200-2026-11-22.csv"


@mark
def gpu_tests():
    of = rows(GPU_TESTS)
    if any(r["passed"] != r["tests"] for r in of):
        raise LookupError(f"bench/results/{GPU_TESTS}: not all tests passed")
    return f"{sum(r['passed'] for r in of):.0f} tests: " + listed(f"{r['passed']:.0f} of `{r['program']}`" for r in of)


@mark
def gpu_tests_machine():
    return head(GPU_TESTS)[0]


@mark
def cuda_own():
    return both(rows("accuracy-cuda-h200.csv"))


@mark
def cuda_times():
    of = where(rows("accuracy-cuda-h200.csv"), scene="demo", density_scaling=100.0)
    return (f"{thousands(of[0]['steps'])} steps take " +
            ", ".join(f"{r['seconds']:.2f} s ({r['precision']})" for r in of))


# ---- pieces

@mark
def asserted(file, test, name, literal):
    return minus(common.asserted(file, test, name, literal))


@mark
def voro_difference():
    value = one(rows("tessellation.csv"), quantity="largest_area_difference")["value"]
    return minus(power(upto(value)))


@mark
def voro_times():
    of = {r["quantity"]: r["value"] for r in rows("tessellation.csv")}
    return plain(of["voro_s"] / of["macadam_s"], 2)


@mark
def computed_step():
    return verification.step_range()


@mark
def second_moments():
    of = where(rows("paper-specimens.csv"), scene="ac14_ss_am1")
    return f"{100 * mean(r['second_moment_difference'] for r in of):.0f} %"


@mark
def lighter():
    """Returns by how much the sum of the spheres' volumes is smaller than the box in the specimens of clusters."""
    import paper_runs
    from paper_tables import CLUSTERS, PAPER
    return percents(1 - run.to_box for name in CLUSTERS for run in paper_runs.committed(PAPER[name].scene))
