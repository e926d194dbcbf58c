# SPDX-License-Identifier: GPL-3.0-or-later
"""The exception for wrong input of a study."""


class StudyError(ValueError):
    """The study, its scene or its folder is wrong. The message names the wrong part, what was found and what was
    expected."""
