# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the figures of a report as files of their own, for papers and slides: SVG, PDF, PNG and, for curves, CSV."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

PIXELS = 1800  # width of a picture as PNG; 15 cm wide at 300 dots per inch


class Export:
    """The folder of the figures. Figures are numbered as on the page; captions.txt has their captions."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self._captions: list[str] = []

    def figure(self, made: Any, number: int, caption: str, alt: str, raster: bool) -> None:
        """Writes a matplotlib figure. raster: the figure has so many parts that they become one picture in SVG and PDF."""
        name = f"figure-{number:02d}-{_slug(alt)}"
        dpi = PIXELS / made.get_size_inches()[0]
        made.savefig(self.folder / f"{name}.png", dpi=dpi)
        if raster:
            for axes in made.axes:
                for part in axes.collections:
                    part.set_rasterized(True)
        for form in ("svg", "pdf"):
            made.savefig(self.folder / f"{name}.{form}", dpi=dpi, metadata={"Date" if form == "svg" else "CreationDate": None})
        table = curves_of(made)
        if len(table):
            table.to_csv(self.folder / f"{name}.csv", index=False)
        self._captions.append(f"Figure {number} ({name}). {caption}")

    def table(self, name: str, table: pd.DataFrame) -> None:
        table.to_csv(self.folder / f"{name}.csv", index=False)

    def write_captions(self) -> None:
        (self.folder / "captions.txt").write_text("\n\n".join(self._captions) + "\n", encoding="utf-8")


def _slug(words: str) -> str:
    return re.sub("[^a-z0-9]+", "-", words.lower()).strip("-")[:48] or "figure"


def curves_of(made: Any) -> pd.DataFrame:
    """Returns the curves, dots and bars of a figure, one row per point: panel, curve, the labels of the two axes with
    their units, x, y, and y_error (NaN if there is no error bar). Pictures and text are not in it."""
    parts = []
    for panel, axes in enumerate(made.axes, 1):
        parts += _bars(axes, panel)
        if not axes.get_xlabel() or not axes.get_ylabel() or axes.images:
            continue  # a picture, or a scale of colours
        bars = {id(c.lines[0]): c for c in axes.containers if getattr(c, "lines", None)}
        caps = {id(cap) for c in bars.values() for cap in c.lines[1]}
        drawn = [line for line in axes.lines if id(line) not in caps and line.get_transform() == axes.transData]
        for k, line in enumerate(drawn):
            bar = bars.get(id(line))
            x, y = (np.asarray(v, float) for v in line.get_data())
            parts.append(_part(axes, panel, (bar or line).get_label(), k, x, y, _errors(bar, y)))
        for k, points in enumerate(c for c in axes.collections if len(c.get_offsets()) > 1):
            x, y = np.asarray(points.get_offsets(), float).T
            parts.append(_part(axes, panel, points.get_label(), k, x, y, np.full(len(x), np.nan)))
    return pd.concat(parts, ignore_index=True) if parts else pd.DataFrame()


def _bars(axes: Any, panel: int) -> list[pd.DataFrame]:
    """Returns the bars of a panel: x and y are the place and the length of a bar, or the length and the place of a
    horizontal one; `name` is the label of the axis at this place."""
    parts = []
    for k, group in enumerate(c for c in axes.containers if getattr(c, "patches", None)):
        flat = group.orientation == "horizontal"
        size = np.array([p.get_width() if flat else p.get_height() for p in group.patches], float)
        at = np.array([p.get_y() + p.get_height() / 2 if flat else p.get_x() + p.get_width() / 2 for p in group.patches])
        axis = axes.yaxis if flat else axes.xaxis
        ticks, names = axis.get_ticklocs(), [label.get_text() for label in axis.get_ticklabels()]
        x, y = (size, at) if flat else (at, size)
        part = _part(axes, panel, group.get_label(), k, x, y, np.full(len(at), np.nan))
        if len(ticks) and len(names) == len(ticks):
            part["name"] = [names[int(np.argmin(np.abs(ticks - place)))] for place in at]
        parts.append(part)
    return parts


def _part(axes: Any, panel: int, label: str, number: int, x: Any, y: Any, error: Any) -> pd.DataFrame:
    name = f"curve {number + 1}" if not label or label.startswith("_") else label
    return pd.DataFrame(
        {"panel": panel, "curve": name, "x_label": axes.get_xlabel(), "y_label": axes.get_ylabel(), "x": x, "y": y, "y_error": error}
    )


def _errors(bar: Any, y: np.ndarray) -> np.ndarray:
    """Returns half the length of the error bar at each point; NaN without error bars."""
    segments = bar.lines[2][0].get_segments() if bar is not None and bar.lines[2] else []
    if len(segments) != len(y):
        return np.full(len(y), np.nan)
    return np.array([(s[1][1] - s[0][1]) / 2 if len(s) == 2 else np.nan for s in segments])
