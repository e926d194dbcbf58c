# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/history.md uses the marks of bench.py."""

DOCUMENT = "bench/history.md"
