# SPDX-License-Identifier: GPL-3.0-or-later
"""One Laguerre cell of a specimen in a box, with its facets as polygons, for drawings. Lengths have any unit."""
import numpy as np


def clipped(polygon, normal, offset):
    """Returns the part of a polygon (m, 3) with normal · x <= offset."""
    out = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0)):
        above_a, above_b = normal @ a - offset, normal @ b - offset
        if above_a <= 0:
            out.append(a)
        if above_a * above_b < 0:
            out.append(a + (b - a) * above_a / (above_a - above_b))
    return np.array(out)


def cell(centre, radius, box, i):
    """Returns {neighbour: polygon} of the Laguerre cell of particle i; walls have the keys -1 to -6."""
    planes = {}
    for j in range(len(centre)):
        if j != i:
            between = centre[j] - centre[i]
            distance = np.linalg.norm(between)
            lever = (distance**2 + radius[i]**2 - radius[j]**2) / (2 * distance)
            normal = between / distance
            planes[j] = normal, normal @ centre[i] + lever
    for axis in range(3):
        planes[-1 - 2 * axis] = -np.eye(3)[axis], 0.0
        planes[-2 - 2 * axis] = np.eye(3)[axis], box[axis]
    facets = {}
    for j, (normal, offset) in planes.items():
        s, t = frame(normal)
        middle = centre[i] + (offset - normal @ centre[i]) * normal
        polygon = np.array([middle + 99 * (a * s + b * t) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        for k, plane in planes.items():
            if k != j and len(polygon):
                polygon = clipped(polygon, *plane)
        if len(polygon) > 2:
            facets[j] = polygon
    return facets


def frame(normal):
    """Returns two unit vectors s, t with s × t = normal."""
    s = np.cross(np.eye(3)[np.argmin(np.abs(normal))], normal)
    s /= np.linalg.norm(s)
    return s, np.cross(normal, s)


def centroid(polygon):
    """Returns the centroid of a plane polygon (m, 2)."""
    a, b = polygon, np.roll(polygon, -1, axis=0)
    area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])[:, None]
    return ((a + b) * area).sum(axis=0) / (3 * area.sum())
