# SPDX-License-Identifier: GPL-3.0-or-later
"""macadam study STUDY.toml --out DIR"""

from __future__ import annotations

import argparse
import signal
import sys

from macadam.study import StudyError, study
from macadam.study.design import read_design
from macadam.study.executors import PLACES
from macadam.study.program import find_program, version_of


def main(arguments: list[str] | None = None) -> int:
    """The command; its exit code: 0 all computed, 1 something failed or is missing, 2 the input is wrong."""
    parser = argparse.ArgumentParser(
        prog="macadam study",
        description="Computes a scene at many points: grids, Latin hypercubes or lists over its keys. "
        "What is in the folder already is not computed again.",
        epilog="example: macadam study study.toml --out results/study",
    )
    parser.add_argument("study", metavar="STUDY.toml", help="what to vary; docs/studies.md explains it")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of the study; made if it is not there")
    parser.add_argument(
        "--on",
        choices=PLACES,
        help="instead of the study's: this machine by Parsl, a Slurm cluster, or threads of this process",
    )
    parser.add_argument(
        "--workers", type=int, metavar="N", help="programs at a time on a machine, instead of the study's"
    )
    parser.add_argument("--retry-failed", action="store_true", help="try points again that failed")
    parser.add_argument("--list", action="store_true", help="print the points and compute nothing")
    options = parser.parse_args(arguments)
    shown = sys.stderr.isatty()

    def progress(done: int, failed: int, asked: int) -> None:
        if shown:
            print(f"\r{done} of {asked} done, {failed} failed ", end="", file=sys.stderr, flush=True)

    def stop(*_: object) -> None:  # SIGTERM as Ctrl-C: what waits is not begun
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, stop)
    try:
        if options.list:
            jobs = read_design(options.study, version_of(find_program())).jobs
            for job in jobs:
                print(job.key, job.experiment, *(f"{k}={v}" for k, v in job.values.items()))
            return 0
        found = study(
            options.study,
            options.out,
            on=options.on,
            workers=options.workers,
            retry_failed=options.retry_failed,
            progress=progress,
        )
    except StudyError as error:
        print(f"{chr(10) if shown else ''}macadam study: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"macadam study: {error.filename or options.out}: {error.strerror or error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nmacadam study: stopped; the same command goes on from here", file=sys.stderr)
        return 130
    if shown:
        print(file=sys.stderr)
    for failure in found.failures:
        values = ", ".join(f"{k} = {v}" for k, v in failure["values"].items())
        print(
            f"failed: {failure['experiment']} {values}: {failure['message'].splitlines()[-1]}".replace(":  ", ": "),
            file=sys.stderr,
        )
    if found.missing:
        print(
            f"macadam study: {found.missing} jobs were not computed: their workers died; the logs are in "
            f"{found.folder / 'parsl'}",
            file=sys.stderr,
        )
    names = [n for n in ("table.csv", "table.parquet", "failures.csv", "report.html") if (found.folder / n).is_file()]
    print(
        f"{found.table['key'].nunique() if len(found.table) else 0} results, {len(found.failures)} failed | files in "
        f"{options.out}: {' '.join(names)}"
    )
    return 1 if found.failures or found.missing else 0


if __name__ == "__main__":
    sys.exit(main())
