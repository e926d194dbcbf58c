# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of examples/ac14_ss_am2/README.md."""
from pages import single_spheres

DOCUMENT = "examples/ac14_ss_am2/README.md"
PARTS = (single_spheres,)
