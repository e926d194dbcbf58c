# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a study that is asked for wrongly."""


class StudyError(ValueError):
    """The study, its scene or its folder is wrong: the message names what, what was found and what was expected."""
