# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/laws-from-data.md, whose marks are those of examples/mastic."""

DOCUMENT = "docs/laws-from-data.md"
