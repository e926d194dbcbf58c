# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives: displacements [m] or forces [N] of a wall along one axis, as functions of the step."""
from ._core import ConstantRate, Cyclic, Drive, Haversine, Ramp, Table

__all__ = ["ConstantRate", "Cyclic", "Drive", "Haversine", "Ramp", "Table"]
