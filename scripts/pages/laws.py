# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/laws-from-data.md uses the marks of examples/mastic."""

DOCUMENT = "docs/laws-from-data.md"
