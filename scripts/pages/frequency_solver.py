# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/frequency-solver.md uses the marks of accuracy.py."""

DOCUMENT = "docs/frequency-solver.md"
