# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/start.md: what its command prints."""
from pages.marks import mark
from pages.readme import shown

DOCUMENT = "docs/start.md"


@mark
def specimen():
    return shown("start-output.txt", ["class", r"[\d.]+-[\d.]+ mm", "mastic {4}", r"\d+ particles"])


@mark
def moduli():
    return shown("start-output.txt", [r" +f \(Hz\)", r" +[\d.]+ +[\d.]+ +[\d.]+ +\d.*e-"])
