# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/reliability.md: campaigns of faults, from tests/faults/campaign --table, and fuzzing, from scripts/fuzz --table."""
from pages.data import head, rows, table
from pages.marks import mark

DOCUMENT = "docs/reliability.md"
FAULTS = "faults.csv"
FUZZING = "fuzzing.csv"
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
