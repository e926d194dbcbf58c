# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/reliability.md: campaigns of faults (tests/faults/campaign --table), fuzzing (scripts/fuzz --table), hours of runs
(tests/soak), races (scripts/races --table, scripts/gpu-sanitizers --table), mistakes on purpose (tests/mutation/campaign --table), the same bits (tests/same_bits/run
--table)."""
import collections

from pages.data import head, rows, table
from pages.marks import mark

DOCUMENT = "docs/reliability.md"
FAULTS = "faults.csv"
FUZZING = "fuzzing.csv"
RACES = "races.csv"
GPU_SANITIZERS = "gpu-sanitizers.csv"
MUTATION = "mutation.csv"
SECOND_MUTATION = "mutation-second.csv"
SAME_BITS = "same-bits.csv"
SOAK = (("cpu", "soak-cpu.csv"), ("cuda", "soak-cuda.csv"), ("cuda", "soak-cuda-h100.csv"))
READS = {"scene": "scenes (TOML)", "model": "models of a binder (TOML)", "specimen": "specimens (CSV)",
         "specimen_gz": "specimens (CSV in gzip)", "laboratory": "laboratory data (CSV)", "checkpoint": "checkpoints (HDF5)",
         "off": "surfaces (OFF)", "obj": "surfaces (OBJ)", "stl": "surfaces (STL)", "ply": "surfaces (PLY)",
         "mha": "headers of scans (MetaImage)", "nrrd": "headers of scans (NRRD)", "tif": "headers of scans (TIFF)",
         "h5": "headers of scans (HDF5)"}


@mark
def faults_machine():
    return head(FAULTS)[0]


@mark
def faults():
    return table(["campaign", "trials", "failures"],
                 [(r["campaign"], f"{r['trials']:,.0f}", f"{r['failures']:.0f}") for r in rows(FAULTS)])


@mark
def fuzzing_machine():
    return head(FUZZING)[0]


@mark
def fuzzing_executions():
    return f"{sum(r['executions'] for r in rows(FUZZING)):,.0f}"


@mark
def fuzzing_findings():
    return f"{sum(r['findings'] for r in rows(FUZZING)):.0f}"


@mark
def fuzzing():
    return table(["target", "what it reads", "executions", "edges", "findings", "slowest input [s]", "most memory [MB]"],
                 [(f"`{r['target']}`", READS[r["target"]], f"{r['executions']:,.0f}", f"{r['edges']:.0f}", f"{r['findings']:.0f}",
                   f"{r['slowest_s']:.2g}", f"{r['peak_mb']:.1f}") for r in rows(FUZZING)], right=(2, 3, 4, 5, 6))


@mark
def faults_long():
    return table(["campaign", "trials", "failures", "where"],
                 [(r["campaign"], f"{r['trials']:,.0f}", f"{r['failures']:.0f}", r["where"]) for r in rows("faults-long.csv")], right=(1, 2))


@mark
def soak():
    """The most that was held until two thirds of the time, and in the last third."""
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
def races_machine():
    return head(RACES)[0]


@mark
def races_programs():
    return f"{sum(r['tests'] > 0 for r in rows(RACES))}"


@mark
def races_tests():
    return f"{sum(r['tests'] for r in rows(RACES)):,.0f}"


@mark
def races_found():
    return f"{sum(r['reports'] for r in rows(RACES)):.0f}"


@mark
def gpu_sanitizers_machine():
    return head(GPU_SANITIZERS)[0]


@mark
def gpu_sanitizers_reports():
    return f"{sum(r['reports'] for r in rows(GPU_SANITIZERS)):.0f}"


@mark
def gpu_sanitizers():
    """Tests that ended of those that use the GPU, by program and check."""
    programs = collections.defaultdict(dict)
    for r in rows(GPU_SANITIZERS):
        programs[r["program"]][r["check"]] = f"{r['ended']:.0f} of {r['tests'] - r['unused']:.0f}"
    checks = ("memcheck", "initcheck", "racecheck", "synccheck")
    return table(["program", *(f"`{check}`" for check in checks)],
                 [(f"`{program}`", *(ended.get(check, "") for check in checks)) for program, ended in programs.items()], right=range(1, 5))


@mark
def mutation_machine():
    return head(MUTATION)[0]


@mark
def mutation():
    """By folder of the sources."""
    folders = collections.defaultdict(collections.Counter)
    for r in rows(MUTATION):
        folders["/".join(r["file"].split("/")[:2]) if r["file"].startswith("host/") else "kernels"][r["verdict"]] += 1
    names = ("killed", "survived", "not reached")
    listed = [(f"`{name}`", sum(c.values()), *(c[v] for v in names)) for name, c in sorted(folders.items())]
    listed.append(("all", *(sum(row[k] for row in listed) for k in range(1, 5))))
    return table(["sources", "mistakes", "noticed", "not noticed", "no test comes by"], listed, right=range(1, 5))


def noticed(file):
    """Share of the mistakes that a test comes by."""
    count = collections.Counter(r["verdict"] for r in rows(file))
    return f"{100 * count['killed'] / (count['killed'] + count['survived']):.0f} %"


@mark
def mutation_share():
    return noticed(MUTATION)


@mark
def second_mutation_machine():
    return head(SECOND_MUTATION)[0]


@mark
def second_mutation_number():
    return str(len(rows(SECOND_MUTATION)))


@mark
def second_mutation_share():
    return noticed(SECOND_MUTATION)


def looked_at(*kinds):
    return sum(r["looked_at"] in kinds for r in rows("mutation-survivors.csv"))


@mark
def survivors():
    """What was seen when those that no test noticed were looked at."""
    said = {"same": "no result differs, or only where two numbers are the same (`<` for `<=`)",
            "shown": "words, pictures and progress that people read", "start": "first guesses and the order of work: the end is the same",
            "beyond": "read or written beyond an array, which only the tests with sanitizers can see",
            "tested since": "a test notices it since", "open": "a test could notice it"}
    return table(["mistakes that no test noticed", "number"], [(words, looked_at(kind)) for kind, words in said.items()])


@mark
def mutation_since():
    """Share of those that change anything, whether or not a test comes by."""
    killed = sum(r["verdict"] == "killed" for r in rows(MUTATION)) + looked_at("tested since")
    return f"{100 * killed / (len(rows(MUTATION)) - looked_at('same')):.0f} %"


@mark
def same_bits_machine():
    return head(SAME_BITS)[0]


@mark
def same_bits():
    files = ("specimen.csv", "response.csv", "contacts.csv")
    return table(["compiler", "optimised", "for the processor", "runs", *(f"other bytes in `{name}`" for name in files)],
                 [(r["compiler"], f"`{r['level']}`", r["processor"].replace("native", "of this machine"), f"{r['runs']:.0f}",
                   *(f"{r[name]:.0f}" for name in files)) for r in rows(SAME_BITS)], right=range(3, 7))
