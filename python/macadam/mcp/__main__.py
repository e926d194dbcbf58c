# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `macadam mcp --folder DIR`."""

from __future__ import annotations

import argparse
import sys

from macadam.mcp.paths import RequestError
from macadam.mcp.workspace import Workspace


def main(arguments: list[str] | None = None) -> int:
    """Runs the server until its standard input ends. Returns the exit code: 0 the server has ended, 2 wrong input."""
    parser = argparse.ArgumentParser(
        prog="macadam mcp",
        description="Serves the Model Context Protocol on standard input and output, so that an assistant can make, check "
        "and run scenes and read results. It works only in one folder.",
        epilog="example: macadam mcp --folder ~/mixes",
    )
    parser.add_argument("--folder", required=True, metavar="DIR", help="folder of scenes and results")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="threads of a run (default: the program's choice)")
    options = parser.parse_args(arguments)
    try:
        workspace = Workspace(options.folder, options.threads)
    except RequestError as error:
        print(f"macadam mcp: {error}", file=sys.stderr)
        return 2
    try:
        from macadam.mcp.server import make_server
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith("mcp"):
            raise
        print(
            f"macadam mcp: {sys.executable}: found no Python package mcp 2 or later, expected it; install it with "
            "pip install 'macadam[mcp]'",
            file=sys.stderr,
        )
        return 2
    make_server(workspace).run()
    return 0


if __name__ == "__main__":
    sys.exit(main())
