# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `macadam report DIR [DIR…] --out report.html`."""

from __future__ import annotations

import argparse
import sys

from macadam.report import ReportError, report


def main(arguments: list[str] | None = None) -> int:
    """Runs the command. Returns its exit code: 0 the report was written, 1 it could not be written, 2 wrong input."""
    parser = argparse.ArgumentParser(
        prog="macadam report",
        description="Writes one HTML file about result folders: mix, specimen, |E*| and phase angle, contacts, "
        "decisions, times. The file needs no network and prints on A4.",
        epilog="example: macadam report results/demo results/paper --out report.html",
    )
    parser.add_argument("dirs", nargs="+", metavar="DIR", help="folder of results; several are shown side by side")
    parser.add_argument("--out", default="report.html", metavar="FILE", help="file to write (default: report.html)")
    parser.add_argument("--title", help="title of the page (default: the names of the folders)")
    parser.add_argument(
        "--figures",
        metavar="DIR",
        help="also write each figure into this folder: SVG, PDF, PNG of 1,800 pixels and, if it has curves, CSV",
    )
    parser.add_argument(
        "--view",
        action="store_true",
        help="also write a view in three dimensions of each specimen beside the report, FILE-3d.html; needs the Python "
        "package k3d",
    )
    options = parser.parse_args(arguments)
    try:
        print(report(options.dirs, options.out, options.title, figures=options.figures, view=options.view))
    except ReportError as error:
        print(f"macadam report: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"macadam report: {error.filename or options.out}: {error.strerror or error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
