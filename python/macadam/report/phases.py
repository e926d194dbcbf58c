# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of phases in all pictures of specimens: mastic, voids, aggregates, and size classes of aggregates.

The colour of a size class depends only on its two sieves: it is the colour of the interval of SIEVES that contains the
geometric mean of the two. So a class has the same colour in every picture. LADDER has one colour per interval.
The colours of classes of one mix can be distinguished with all kinds of colour vision
(python/tests/test_report_colours.py).

The module needs only Python's standard library, because scripts/specimen_colours.py loads it without the package."""

from __future__ import annotations

import colorsys
import math
import re
from bisect import bisect_right

MASTIC, VOID = "#6687c2", "#ffffff"
AGGREGATE = "#ab8f66"  # an aggregate whose size class is not known
SIEVES = (0.063, 0.125, 0.25, 0.5, 1.0, 2.0, 2.8, 4.0, 5.6, 8.0, 11.2, 16.0, 22.4, 31.5, 45.0, 63.0)  # [mm]
LADDER = (
    "#983d10",  # 0.063 to 0.125 mm
    "#564db9",
    "#710000",  # 0.25 to 0.5 mm
    "#de8b5d",
    "#7e4884",  # 1 to 2 mm
    "#6bc9c0",
    "#c8673f",  # 2.8 to 4 mm, also 2-4.75 mm
    "#662a6c",
    "#e7b83c",  # 5.6 to 8 mm, also 4.75-9.5 mm
    "#a9a39a",
    "#1d6650",  # 11.2 to 16 mm, also 12.5-19 mm
    "#c6d199",
    "#663d99",  # 22.4 to 31.5 mm
    "#97adfb",
    "#bf8a1a",  # 45 to 63 mm
)
_SIZES = re.compile(r"\s*([\d.]+)\s*[-–]\s*([\d.]+)\s*mm\s*$")  # "4.75-9.5 mm", with a hyphen or an en dash
_GOLDEN, _SECOND = 0.6180339887, 0.7548776662  # multiples of them give consecutive numbers very different shades


def of_size(millimetres: float) -> str:
    """Returns the colour of aggregates of one size [mm]. Sizes outside SIEVES have the colour of the nearest
    interval."""
    return LADDER[min(max(bisect_right(SIEVES, millimetres) - 1, 0), len(LADDER) - 1)]


def of_sieves(lower: float, upper: float) -> str:
    """Returns the colour of the size class between two sieves [mm]."""
    return of_size(math.sqrt(lower * upper))


def of_class(name: str | None) -> str:
    """Returns the colour of a size class by its name, such as "4.75-9.5 mm"; AGGREGATE if the name has no sieves."""
    sizes = _SIZES.match(name or "")
    return of_sieves(float(sizes[1]), float(sizes[2])) if sizes and float(sizes[1]) > 0 else AGGREGATE


def rgb(colour: str) -> tuple[float, float, float]:
    """Returns red, green and blue, each from 0 to 1, of a colour "#rrggbb"."""
    red, green, blue = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return red, green, blue


def shaded(colour: str, body: int, particle: int | None = None) -> tuple[float, float, float]:
    """Returns the colour of an aggregate, or of one sphere of it: the given colour in a lightness that differs between
    bodies and between particles."""
    hue, lightness, saturation = colorsys.rgb_to_hls(*rgb(colour))
    change = 0.24 * ((body * _GOLDEN) % 1 - 0.5)
    if particle is not None:
        change += 0.20 * ((particle * _SECOND) % 1 - 0.5)
    return colorsys.hls_to_rgb(hue, min(0.92, max(0.12, lightness * (1 + change))), saturation)
