# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/develop-reliability.md: injected faults (tests/faults/campaign --table), fuzzing (scripts/fuzz --table), hours
of runs (tests/soak), races (scripts/races --table, scripts/gpu-sanitizers --table), deliberate mistakes in the code
(tests/mutation/campaign --table), bitwise equal results (tests/same_bits/run --table)."""
import collections

from pages.data import head, rows, table
from pages.marks import mark

DOCUMENT = "docs/develop-reliability.md"
DRAWS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh")
MUTATION = ("mutation", *(f"mutation-{draw}" for draw in DRAWS[1:]))
SOAK = (("cpu", "soak-cpu.csv"), ("cuda", "soak-cuda.csv"), ("cuda", "soak-cuda-h100.csv"))
READS = {"scene": "scenes (TOML)", "model": "models of a binder (TOML)", "specimen": "specimens (CSV)",
         "specimen_gz": "specimens (CSV in gzip)", "laboratory": "laboratory data (CSV)", "checkpoint": "checkpoints (HDF5)",
         "off": "surfaces (OFF)", "obj": "surfaces (OBJ)", "stl": "surfaces (STL)", "ply": "surfaces (PLY)",
         "mha": "scans (MetaImage)", "nrrd": "scans (NRRD)", "tif": "scans (TIFF)",
         "h5": "scans (HDF5)"}


@mark
def measured(name):
    """Returns the first line of a file of results, which says when and where it was measured."""
    return head(f"{name}.csv")[0]


@mark
def total(name, column):
    return f"{sum(r[column] for r in rows(f'{name}.csv')):,.0f}"


@mark
def faults():
    return table(["campaign", "trials", "failures"],
                 [(r["campaign"], f"{r['trials']:,.0f}", f"{r['failures']:.0f}") for r in rows("faults.csv")])


@mark
def fuzzing():
    return table(["target", "what it reads", "executions", "edges", "findings", "slowest input [s]", "most memory [MB]"],
                 [(f"`{r['target']}`", READS[r["target"]], f"{r['executions']:,.0f}", f"{r['edges']:.0f}", f"{r['findings']:.0f}",
                   f"{r['slowest_s']:.2g}", f"{r['peak_mb']:.1f}") for r in rows("fuzzing.csv")], right=(2, 3, 4, 5, 6))


@mark
def faults_long():
    return table(["campaign", "trials", "failures", "where"],
                 [(r["campaign"], f"{r['trials']:,.0f}", f"{r['failures']:.0f}", r["where"]) for r in rows("faults-long.csv")], right=(1, 2))


@mark
def soak():
    """Returns the largest memory in the first two thirds of the time and in the last third."""
    out = []
    for backend, file in SOAK:
        all_ = rows(file)
        third = len(all_) - len(all_) // 3

        def most(column, part):
            return max(r[column] for r in part)

        def both(column, digits):
            return f"{most(column, all_[:third]):.{digits}f} / {most(column, all_[third:]):.{digits}f}"
        last = all_[-1]
        out.append((backend, head(file)[0], f"{last['seconds'] / 60:.0f}", f"{last['runs']:,.0f}", f"{last['resumes']:,.0f}",
                    both("resident_mb", 1), both("allocated_mb", 2), both("device_mb", 0) if backend == "cuda" else "",
                    both("files", 0), both("threads", 0)))
    return table(["backend", "measured", "minutes", "runs", "resumed", "resident, before / last third [MB]", "allocated [MB]",
                  "device [MB]", "open files", "threads"], out, right=range(2, 10))


@mark
def checked():
    """Returns the table of tests in builds with sanitizers."""
    return table(["build", "ran", "failed", "left out"],
                 [(r["what"], f"{r['tests'] - r['skipped']:,.0f}", f"{r['failed']:.0f}", f"{r['skipped']:.0f}") for r in rows("checked.csv")], right=(1, 2, 3))


@mark
def coverage(what):
    row = next(r for r in rows("coverage.csv") if r["what"] == what)
    return f"{100 * row['covered'] / row['of']:.1f} %"


@mark
def races_programs():
    return f"{sum(r['tests'] > 0 for r in rows('races.csv'))}"


def ended_under_sanitizers(name):
    """Returns the table of tests that ended, out of those that use the GPU, by program and check."""
    programs = collections.defaultdict(dict)
    for r in rows(f"{name}.csv"):
        programs[r["program"]][r["check"]] = f"{r['ended']:.0f} of {r['tests'] - r['unused']:.0f}"
    checks = ("memcheck", "initcheck", "racecheck", "synccheck")
    return table(["program", *(f"`{check}`" for check in checks)],
                 [(f"`{program}`", *(ended.get(check, "") for check in checks)) for program, ended in programs.items()], right=range(1, 5))


@mark
def gpu_sanitizers():
    return ended_under_sanitizers("gpu-sanitizers")


@mark
def gpu_sanitizers_again():
    return ended_under_sanitizers("gpu-sanitizers-again")


@mark
def mutation():
    """Returns the table of verdicts by folder of the sources, over all samples of mistakes."""
    folders = collections.defaultdict(collections.Counter)
    for r in (r for name in MUTATION for r in rows(f"{name}.csv")):
        folder = r["file"].split("/")[:-1][:2]
        folders["/".join(folder) if folder[0] == "host" else "kernels"][r["verdict"]] += 1
    verdicts = ("killed", "survived", "not reached")
    listed = [("`host` itself" if name == "host" else f"`{name}`", sum(c.values()), *(c[v] for v in verdicts)) for name, c in sorted(folders.items())]
    listed.append(("all", *(sum(row[k] for row in listed) for k in range(1, 5))))
    return table(["sources", "mistakes", "detected", "not detected", "in code that no test reaches"], listed, right=range(1, 5))


# Returns how many deliberate mistakes have each verdict: killed (a test noticed it), survived, and others.
def verdicts(name):
    return collections.Counter(r["verdict"] for r in rows(f"{name}.csv"))


# Returns how many of the mistakes that no test noticed were found to be of each kind.
def looked_at(name):
    return collections.Counter(r["looked_at"] for r in rows(f"{name}-survivors.csv"))


@mark
def drawn(name):
    return str(len(rows(f"{name}.csv")))


@mark
def noticed(name):
    """Returns the share of mistakes that were noticed, of those in code that a test runs."""
    count = verdicts(name)
    return f"{100 * count['killed'] / (count['killed'] + count['survived']):.0f} %"


@mark
def noticed_at_once(name):
    """Returns the share of mistakes that were noticed, of all that change a result, whether or not a test runs the
    code; tests written later because of these mistakes do not count."""
    return f"{100 * verdicts(name)['killed'] / (len(rows(f'{name}.csv')) - looked_at(name)['same']):.1f} %"


@mark
def chance_of_draw(name):
    """Returns the standard deviation of noticed_at_once() due to the random sample."""
    number = len(rows(f"{name}.csv")) - looked_at(name)["same"]
    share = verdicts(name)["killed"] / number
    return f"{100 * (share * (1 - share) / number) ** 0.5:.1f} %"


@mark
def noticed_since(name):
    """Returns noticed_at_once() including the tests that were written later because of these mistakes."""
    killed = verdicts(name)["killed"] + looked_at(name)["tested since"]
    return f"{100 * killed / (len(rows(f'{name}.csv')) - looked_at(name)['same']):.1f} %"


@mark
def survivors():
    """Returns the table of reasons found when the mistakes that no test noticed were examined, by sample."""
    said = {"same": "no result differs, or only if two numbers are equal (`<` for `<=`)",
            "shown": "messages, pictures and progress", "start": "initial guesses and the order of work; the result is the same",
            "beyond": "access beyond an array, which only sanitizers detect",
            "tested since": "a test written since detects it", "open": "a test could detect it"}
    found = [looked_at(name) for name in MUTATION]
    return table(["undetected mistakes", *(f"{draw} sample" for draw in DRAWS)],
                 [(words, *(count[kind] for count in found)) for kind, words in said.items()], right=range(1, 1 + len(DRAWS)))


@mark
def not_looked_at():
    """Returns the numbers of mistakes that no test noticed, in code that no test runs, and that nobody examined, by
    sample."""
    left = {draw: len(rows(f"{name}.csv")) - verdicts(name)["killed"] - sum(looked_at(name).values()) for name, draw in zip(MUTATION, DRAWS)}
    return " and ".join(f"{number} of the {draw} sample, in code that no test reaches" for draw, number in left.items() if number)


@mark
def same_bits():
    files = ("specimen.csv", "response.csv", "contacts.csv")
    return table(["compiler", "optimised", "for the processor", "runs", *(f"other bytes in `{name}`" for name in files)],
                 [(r["compiler"], f"`{r['level']}`", r["processor"].replace("native", "of this machine"), f"{r['runs']:.0f}",
                   *(f"{r[name]:.0f}" for name in files)) for r in rows("same-bits.csv")], right=range(3, 7))
