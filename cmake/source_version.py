# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells scikit-build-core the version of the Python package, which scripts/version prints for the source tree."""
import subprocess
from pathlib import Path


def dynamic_metadata(field, settings=None, project=None):
    if field != "version" or settings:
        raise ValueError(f"pyproject.toml: found {field} with {settings}, expected version without settings")
    script = Path(__file__).resolve().parent.parent / "scripts" / "version"
    return subprocess.run([script], capture_output=True, text=True, check=True).stdout.strip()
