# SPDX-License-Identifier: GPL-3.0-or-later
"""What walls do along an axis, as functions of the step: displacements [m] or forces [N]."""
from ._core import ConstantRate, Cyclic, Drive, Haversine, Ramp, Table

__all__ = ["ConstantRate", "Cyclic", "Drive", "Haversine", "Ramp", "Table"]
