# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the aggregates as spheres in the box, from back to front."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.collections import EllipseCollection, LineCollection

from macadam.report import look

# A sphere is drawn as several circles, which together look round. Each circle has three numbers: its radius and
# its shift towards the light, both divided by the radius of the sphere, and its brightness.
_SHADES = [(1.0, 0.0, 0.42), (0.955, 0.02, 0.72), (0.82, 0.10, 0.86), (0.62, 0.20, 0.97), (0.36, 0.30, 1.08)]
_LIGHT = np.array([-0.6, 0.8])
_MOST = 30_000  # largest number of spheres drawn; if there are more, only the largest spheres are drawn


def spheres(
    specimen: pd.DataFrame, box: np.ndarray, paint: Callable[[np.ndarray], np.ndarray], view: np.ndarray, height: float
) -> tuple[Any, str]:
    """Returns the figure and its caption. view: rows right, up and towards the eye. Lengths are in metres, the `height`
    of the picture in inches."""
    rows = np.flatnonzero((specimen["phase"] == "aggregate").to_numpy())
    words = "The aggregates in the box"
    words += "; the mastic between them is not drawn." if (specimen["phase"] == "mastic").any() else "."
    radius = specimen["radius"].to_numpy(float)
    if len(rows) > _MOST:
        words += f" Of {look.number(len(rows))} spheres the {look.number(_MOST)} largest are drawn."
        rows = largest(radius, rows, _MOST)
    place = specimen[["x", "y", "z"]].to_numpy(float)[rows] @ view.T
    order = np.argsort(place[:, 2])
    place, radius, colour = place[order], radius[rows][order], paint(rows)[order]
    near = (place[:, 2] - place[:, 2].min()) / max(np.ptp(place[:, 2]), 1e-12)
    colour = colour * (0.62 + 0.38 * near)[:, None] + 0.30 * (1 - near)[:, None]  # distant spheres are paler

    corners = np.array(list(product(*([0, e] for e in box)))) @ view.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    figure, axes = look.figure(look.THIRD, height)
    outline(axes, corners, "#b9bec6", True)
    at = (place[:, None, :2] + radius[:, None, None] * np.array([s * _LIGHT for _, s, _ in _SHADES])[None]).reshape(
        -1, 2
    )
    width = (2 * radius[:, None] * np.array([r for r, _, _ in _SHADES])[None]).ravel()
    face = np.clip(colour[:, None] * np.array([b for *_, b in _SHADES])[None, :, None], 0, 1).reshape(-1, 3)
    axes.add_collection(
        EllipseCollection(
            width,
            width,
            np.zeros(len(width)),
            units="xy",
            offsets=at,
            facecolors=face,
            transOffset=axes.transData,
            linewidths=0,
        )
    )
    outline(axes, corners, "#5a5f68", False)
    frame(axes, low, high)
    return figure, words


def largest(size: np.ndarray, rows: np.ndarray, most: int) -> np.ndarray:
    """Returns the rows with the largest sizes, at most `most` of them, in the order of `rows`."""
    if len(rows) <= most:
        return rows
    return rows[np.sort(np.argsort(-size[rows], kind="stable")[:most])]


def outline(axes: Any, corners: np.ndarray, colour: str, behind: bool | None = None) -> None:
    """Draws edges of the box. corners: eight, as (right, up, towards the eye). behind: True for the edges at the back,
    False for those in front, None for all."""
    hidden = int(np.argmin(corners[:, 2]))
    edges = [(i, j) for i, j in product(range(8), repeat=2) if i < j and bin(i ^ j).count("1") == 1]
    chosen = [e for e in edges if behind is None or (hidden in e) == behind]
    axes.add_collection(
        LineCollection([[corners[i, :2], corners[j, :2]] for i, j in chosen], colors=colour, linewidths=0.5)
    )


def frame(axes: Any, low: np.ndarray, high: np.ndarray) -> None:
    """Sets the limits of the picture and hides the axes."""
    margin = 0.02 * (high - low)
    axes.set(xlim=(low[0] - margin[0], high[0] + margin[0]), ylim=(low[1] - margin[1], high[1] + margin[1]))
    axes.set_aspect("equal")
    axes.axis("off")
