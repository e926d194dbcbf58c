# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `macadam study STUDY.toml --out DIR`."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from typing import Any

_NOTES = 20  # largest number of printed lines about points with equal scenes
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class _Stop:
    """A signal handler that raises KeyboardInterrupt at the first signal. It ignores later signals, because tables and
    report are being written then."""

    asked = False

    def __call__(self, *_: Any) -> None:
        if not self.asked:
            self.asked = True
            raise KeyboardInterrupt

    def check(self) -> None:
        """Raises KeyboardInterrupt again after a signal, because a library may have caught the first one."""
        if self.asked:
            raise KeyboardInterrupt


def main(arguments: list[str] | None = None) -> int:
    """Runs the command. Returns its exit code: 0 all computed, 1 some failed or missing, 2 wrong input, 130 stopped."""
    stop = _Stop()
    before = {}
    for number in _SIGNALS:
        # nohup makes the process ignore signals; such signals stay ignored
        if signal.getsignal(number) is not signal.SIG_IGN:
            before[number] = signal.signal(number, stop)
    try:
        return _command(_options(arguments), stop)
    except KeyboardInterrupt:
        print("\nmacadam study: stopped; run the same command again to continue", file=sys.stderr)
        return 130
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


# Parses the command line.
def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="macadam study",
        description="Computes one scene many times with different values of its keys (entries of the scene file): "
        "on a grid, in a Latin hypercube or from a list. "
        "Results that are already in the folder are not computed again.",
        epilog="example: macadam study study.toml --out results/study",
    )
    parser.add_argument(
        "study",
        metavar="STUDY.toml",
        help="file that says which keys to vary (docs/studies.md); with "
        "--seeds, a scene",
    )
    parser.add_argument("--out", required=True, metavar="DIR", help="folder of the study; created if it does not exist")
    parser.add_argument(
        "--on",
        choices=("local", "slurm", "threads"),
        help="where the scenes run, in place of run.on in the study file: local (this machine, through Parsl), slurm (a "
        "Slurm cluster) or threads (of this process)",
    )
    parser.add_argument(
        "--workers",
        type=int,
        metavar="N",
        help="number of programs that run at the same time on one machine, in place of run.workers in the study file",
    )
    parser.add_argument(
        "--seeds",
        type=int,
        metavar="N",
        help="compute the scene STUDY.toml with N seeds of its specimen, and the mean and standard deviation of each result",
    )
    parser.add_argument(
        "--first-seed", type=int, metavar="SEED", help="with --seeds: the first of the seeds, in place of the scene's seed"
    )
    parser.add_argument(
        "--run-option",
        action="append",
        default=[],
        metavar="OPTION",
        help="with --seeds: an option of macadam run, such as --run-option=--precision=mixed; may be given several times",
    )
    parser.add_argument("--retry-failed", action="store_true", help="compute failed points again")
    parser.add_argument("--list", action="store_true", help="print the points and compute nothing")
    parser.add_argument(
        "--check",
        action="store_true",
        help="check the scene of every point by macadam check, print what each point would take, and compute nothing",
    )
    options = parser.parse_args(arguments)
    if options.seeds is None and (options.first_seed is not None or options.run_option):
        parser.error("--first-seed and --run-option need --seeds")
    return options


# Runs, lists or checks a study, as the options say. Returns the exit code.
def _command(options: argparse.Namespace, stop: _Stop) -> int:
    from macadam.study import StudyError, seeds, study
    from macadam.study.driver import checked_design
    from macadam.study.program import find_program, version_of

    shown = sys.stderr.isatty()

    def progress(done: int, failed: int, asked: int) -> None:
        stop.check()
        if shown:
            print(f"\r{done} of {asked} done, {failed} failed ", end="", file=sys.stderr, flush=True)

    try:
        if options.list or options.check:
            program = find_program()
            source: Any = options.study
            if options.seeds is not None:
                source = seeds.study_of(
                    options.study, options.seeds, options.first_seed, options.run_option, options.workers
                )
            design = checked_design(source, version_of(program), options.on, options.workers)
            _print_notes(design.notes)
            for job in design.jobs if options.list else ():
                print(job.key, job.experiment, *(f"{k}={v}" for k, v in job.values.items()))
            return _check(design, program) if options.check else 0
        if options.seeds is not None:
            found, summary = seeds.run(options, progress)
            if shown:
                print(file=sys.stderr)
            print(*seeds.lines(summary), sep="\n")
            return _print_study(found, options.out)
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
    if shown:
        print(file=sys.stderr)
    return _print_study(found, options.out)


def _check(design: Any, program: str) -> int:
    """Checks all scenes. Prints the predictions for all points, and one message about all wrong scenes. Returns the exit
    code."""
    from macadam.study import predictions
    from macadam.study.checks import check_scenes
    from macadam.study.executors import workers

    at_once = workers(design.run)
    checked = check_scenes(design, program, at_once)
    print(*predictions.lines(design, checked, at_once), sep="\n")
    wrong = [one for one in checked if one.message]
    if not wrong:
        return 0
    # a scene that several points share is checked once; its message names one of them
    print(
        f"macadam study: {len(wrong)} of {len(checked)} scenes are wrong",
        *(f"wrong: {one.job.label}: {one.message}" for one in wrong),
        sep="\n",
        file=sys.stderr,
    )
    return 2


def _print_notes(notes: list[str]) -> None:
    for note in notes[:_NOTES]:
        print(f"note: {note}", file=sys.stderr)
    if len(notes) > _NOTES:
        print(f"note: {len(notes) - _NOTES} more points have the same scene as another point", file=sys.stderr)


def _print_study(found: Any, out: str) -> int:
    """Prints the results of a study. Returns the exit code."""
    from macadam.study.programs import error_line
    from macadam.study.table import failed_results

    _print_notes(found.notes)
    for failure in found.failures:
        values = ", ".join(f"{k} = {v}" for k, v in failure["values"].items())
        print(
            f"failed: {failure['experiment']} {values}: {error_line(failure['message'])}".replace(":  ", ": "),
            file=sys.stderr,
        )
    if found.missing:
        print(
            f"macadam study: {found.missing} results were not computed: {found.reason}",
            file=sys.stderr,
        )
    names = [n for n in ("summary.json", "table.csv", "table.parquet", "failures.csv", "report.html") if (found.folder / n).is_file()]
    print(
        f"{found.table['key'].nunique() if len(found.table) else 0} results, {failed_results(found.failures)} failed | files in "
        f"{out}: {' '.join(names)}"
    )
    return 1 if found.failures or found.missing else 0


def end(code: int) -> None:
    """Ends this process. After a stop (130) it does not wait for Parsl's threads, which may wait forever for processes
    that have ended."""
    if code == 130:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


if __name__ == "__main__":
    end(main())
