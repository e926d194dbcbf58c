# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `macadam mixture DESIGN.toml --out DIR`."""

from __future__ import annotations

import argparse
import signal
import sys
from typing import Any

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def main(arguments: list[str] | None = None) -> int:
    """Runs the command. Returns its exit code: 0 done, 1 a run failed, 2 wrong input, 130 stopped."""
    options = _options(arguments)
    # nohup makes the process ignore signals; such signals stay ignored
    for number in _SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _stop)
    try:
        return _command(options)
    except KeyboardInterrupt:
        print("\nmacadam mixture: stopped; run the same command again to continue", file=sys.stderr)
        return 130


def _stop(*_: Any) -> None:
    """Handles the first signal. Later signals are ignored, because programs are being ended then."""
    for number in _SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    raise KeyboardInterrupt


# Parses the command line.
def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="macadam mixture",
        description="Computes |E*| and phase of an asphalt mixture from measurements of its binder and its mix design. "
        "Results that are already in the folder are not computed again.",
        epilog="example: macadam mixture examples/mixture/design.toml --out results/mixture",
    )
    parser.add_argument(
        "design", metavar="DESIGN.toml", help="file with binder, test, recipe and scales (docs/mixture.md)"
    )
    parser.add_argument("--out", metavar="DIR", help="folder of the results; created if it does not exist")
    parser.add_argument(
        "--workers",
        type=int,
        metavar="N",
        help="number of specimens that are solved at the same time, in place of run.workers in the design",
    )
    parser.add_argument(
        "--check", action="store_true", help="check the design, fit the binder, and compute no specimen"
    )
    found = parser.parse_args(arguments)
    if found.workers is not None and found.workers < 1:
        parser.error(f"argument --workers: found {found.workers}, expected 1 or more")
    if not found.check and found.out is None:
        parser.error("argument --out: found nothing, expected the folder of the results")
    return found


# Runs or checks a design, as the options say. Returns the exit code.
def _command(options: argparse.Namespace) -> int:
    from macadam.mixture import MixtureError, mixture

    shown = sys.stderr.isatty()

    def progress(words: str) -> None:
        if shown:
            print(f"\r{words} ", end="", file=sys.stderr, flush=True)

    def say(words: str) -> None:
        print(words, flush=True)

    try:
        if options.check:
            from macadam.mixture.checks import check

            check(options.design, say)
            return 0
        _print(mixture(options.design, options.out, workers=options.workers, progress=progress, say=say), options.out)
        return 0
    except MixtureError as error:
        print(f"{chr(10) if shown else ''}macadam mixture: {error}", file=sys.stderr)
        return error.code
    except OSError as error:
        print(f"macadam mixture: {error.filename or options.out}: {error.strerror or error}", file=sys.stderr)
        return 1


def _print(found: Any, out: str) -> None:
    """Prints the table of results."""
    print("\n                |E*| of the mixture                   predictions (MPa)")
    print(f"{'T (C)':>7} {'f (Hz)':>8} {'(MPa)':>9} {'std (%)':>8} {'phi (deg)':>10} {'Hirsch':>9} {'1-37A':>9}")
    for r in found.table.itertuples():
        print(
            f"{r.temperature_c:7g} {r.frequency_hz:8g} {r.e_star_pa / 1e6:9.4g} "
            f"{100 * r.e_star_std_pa / r.e_star_pa:8.2g} {r.phase_deg:10.1f} {r.e_star_hirsch_pa / 1e6:9.4g} "
            f"{r.e_star_witczak_pa / 1e6:9.4g}"
        )
    runs, seconds = found.summary["runs"], found.summary["timing_s"]["total"]
    print(
        f"{runs['computed']} specimens computed, {runs['reused']} taken from the folder, {seconds:.0f} s | files in "
        f"{out}: mixture.csv master_curve.csv summary.json report.html laws"
    )


if __name__ == "__main__":
    sys.exit(main())
