# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/tutorial-paper.md, whose marks are the README's."""

DOCUMENT = "docs/tutorial-paper.md"
