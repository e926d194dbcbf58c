# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: scenes varied over grids, Latin hypercubes and lists, computed on this machine or a cluster."""

from macadam.study.driver import Study, study
from macadam.study.errors import StudyError

__all__ = ["Study", "StudyError", "study"]
