# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/tutorial-paper.md uses the marks of the README."""

DOCUMENT = "docs/tutorial-paper.md"
