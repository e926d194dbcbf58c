# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of pictures and numbers: colours of curves, matplotlib's settings, figures as text to embed, numbers with
units. The colours of specimens are in phases.py."""

from __future__ import annotations

import base64
import io
import math
from typing import Any

import matplotlib
from matplotlib import colormaps
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

COLOURS = ["#1f5a8a", "#c4532f", "#3c8558", "#80569b", "#b98a1d", "#2f979e", "#a83f70", "#6b6f76"]  # colours of folders
INK = "#22252b"
PAIRS = {"M-M": "#33363d", "M-A": "#1f5a8a", "A-A": "#c4532f", "inner": "#b98a1d", "A-W": "#8f959d", "M-W": "#c3c7cc"}
_WARMTH = LinearSegmentedColormap.from_list("warmth", ["#1d4f91", "#3f8fb0", "#9a76b0", "#d1673f", "#a31621"])
WIDE, THIRD = 7.0, 2.27  # [inches] width of the text, and of one of three pictures side by side

_RC = {
    "font.family": "DejaVu Sans",
    "font.size": 7.5,
    "axes.titlesize": 8,
    "axes.labelsize": 7.5,
    "legend.fontsize": 7,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "axes.edgecolor": "#8a8f98",
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": "#5a5f68",
    "ytick.color": "#5a5f68",
    "axes.linewidth": 0.6,
    "axes.grid": True,
    "grid.color": "#e4e6ea",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "lines.linewidth": 1.3,
    "lines.markersize": 4,
    "legend.frameon": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "macadam",
    "axes.formatter.use_mathtext": True,
    "savefig.dpi": 200,
    "errorbar.capsize": 2,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
}


def style() -> Any:
    """Returns a context manager in which figures have the report's look. It restores matplotlib's settings at its
    end."""
    return matplotlib.rc_context(_RC)


class ShownFigure(Figure):
    """A matplotlib figure that a notebook shows when it is the value of a cell. pyplot is not needed."""

    def _repr_png_(self) -> bytes:
        data = io.BytesIO()
        with style():
            self.savefig(data, format="png", dpi=110)
        return data.getvalue()


def figure(width: float, height: float, rows: int = 1, columns: int = 1, **more: Any) -> tuple[Any, Any]:
    """Returns a matplotlib figure, width and height in inches, and its axes. It needs no window and no display."""
    made = ShownFigure(figsize=(width, height), layout="constrained")
    return made, made.subplots(rows, columns, **more)


def embed(made, raster: bool = False) -> str:
    """Returns the figure as a data URL, which contains the whole picture: as SVG, or as PNG (raster) for figures with
    very many parts."""
    data = io.BytesIO()
    form = "png" if raster else "svg"
    made.savefig(data, format=form, metadata={} if raster else {"Date": None})
    kind = "image/png" if raster else "image/svg+xml"
    return f"data:{kind};base64,{base64.b64encode(data.getvalue()).decode('ascii')}"


def modulus_unit(values: Any) -> tuple[float, str]:
    """Returns factor and name of the unit in which the largest of these moduli [Pa] is at least 1."""
    largest = max((abs(v) for v in values), default=0)
    return next(((f, n) for f, n in ((1e-9, "GPa"), (1e-6, "MPa"), (1e-3, "kPa")) if largest * f >= 1), (1, "Pa"))


def modulus(value: float) -> str:
    """Returns a modulus or stress [Pa] as text with its unit and three digits."""
    factor, name = modulus_unit([value])
    return f"{number(value * factor, 3)} {name}"


def number(value: Any, digits: int = 4) -> str:
    """Returns a number as readable text: `digits` significant digits, thousands separated by commas, a true minus sign;
    an en dash if there is no number."""
    if value is None or isinstance(value, float) and math.isnan(value):
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}".replace("-", "−")
    if not isinstance(value, (float,)):
        return str(value)
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    size = math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}"))))
    if -4 < size < 7:
        text = f"{value:,.{max(0, digits - 1 - size)}f}"
    else:
        mantissa, power = f"{value:.{max(1, digits - 1)}e}".split("e")
        text = f"{mantissa} × 10{str(int(power)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"
    return text.replace("-", "−")


def percent(fraction: Any, digits: int = 3) -> str:
    return "–" if fraction is None else f"{number(100.0 * fraction, digits)} %"


def bound(value: float, unit: str = "") -> str:
    """Returns a small error as text with two digits, or "below 0.001" if it is smaller."""
    if value != value:
        return "–"
    return f"below 0.001{unit}" if abs(value) < 1e-3 else f"{number(float(value), 2)}{unit}"


def warmth(k: int, of: int) -> Any:
    """Returns the colour of the k-th of several temperatures, from cold to warm."""
    return _WARMTH(k / max(1, of - 1))


def steps(k: int, of: int) -> Any:
    """Returns the colour of the k-th of several frequencies, from low to high."""
    return colormaps["viridis"](0.9 * k / max(1, of - 1))


def length(value: float) -> str:
    """Returns a length [m] as text in millimetres with at most five digits."""
    return f"{1e3 * float(value):.5g}"


def seconds(value: float) -> str:
    """Returns a duration [s] as text in a suitable unit, µs to h."""
    if value < 1e-3:
        return f"{number(value * 1e6, 2)} µs"
    if value < 1:
        return f"{number(value * 1e3, 3)} ms"
    if value < 120:
        return f"{number(float(value), 3)} s"
    return f"{number(value / 60, 3)} min" if value < 7200 else f"{number(value / 3600, 3)} h"


def hertz(value: float) -> str:
    return f"{value:.4g} Hz"
