# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/several-gpus.md uses the marks of devices.py."""

DOCUMENT = "docs/several-gpus.md"
