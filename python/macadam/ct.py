# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of computed tomography: `macadam ct …` (docs/ct.md, docs/ct-phantom.md, docs/ct-twin.md).

Lengths are metres, or text with a unit: 25e-6, "25 um". Fractions are numbers, or text in per cent: 0.04, "4 %"."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from typing import Any

from . import _core
from ._scene import Scene

__all__ = ["phantom", "segment", "twin"]

Length = float | str
Fraction = float | str
Path = str | PathLike[str]


# Raises InputError if the library was built without ITK.
def _require_ct() -> None:
    if not _core.info()["ct"]:
        raise _core.InputError("macadam ct: images of computed tomography: found a package built without ITK, expected one "
                               "built with it: install libinsighttoolkit5-dev and build again, with MACADAM_CT=ON")


# Returns a length as the text that the library reads.
def _length(of: Length) -> str:
    return of if isinstance(of, str) else repr(float(of))


# Returns a fraction as a number; text is read as per cent. name: name of the argument, for the message.
def _fraction(of: Fraction | None, name: str) -> float | None:
    if not isinstance(of, str):
        return of
    try:
        if of.rstrip().endswith("%"):
            return float(of.rstrip()[:-1]) / 100
    except ValueError:
        pass
    raise _core.InputError(f"{name}: found \"{of}\", expected a number, or text in per cent: 0.04, \"4 %\"")


def _path(of: Path | None) -> str | None:
    return None if of is None else fspath(of)


def _scene(of: _core.Scene | Mapping[str, Any] | Path) -> _core.Scene:
    return of if isinstance(of, _core.Scene) else Scene(of)


def segment(images: Path, out: Path, *, voxel: Length | Sequence[Length] | None = None, dataset: str = "",
            region: str = "found", slices: bool = True, rings: bool = True, hardening: bool = True,
            denoise: str = "diffusion", air_voids: Fraction | None = None, aggregate: Fraction | None = None, memory: str = "",
            smallest: Length | None = None, gradation: Path | None = None, cuts: Path | None = None, recipe: str = "own",
            facets: int = 500, threads: int | None = None,
            progress: Callable[[str, float], object] | None = None) -> _core.Segmentation:
    """Finds phases and grains in a scan and writes the files into `out`: `macadam ct segment`, with its options and
    defaults.

    images: .mha, .mhd, .nrrd, .tif, .h5 (with `dataset`), or a folder of .tif. voxel: edge length of a voxel, or three,
    which replace those in the file. region: which part of the scan is the specimen. slices, rings, hardening: whether
    slices of different brightness, rings and beam hardening are corrected. air_voids, aggregate: volume fractions
    measured in the laboratory. memory: limit of the memory to use, "3 GB". smallest: diameter of the smallest grain of
    interest. gradation: CSV file with the laboratory's gradation. cuts: a cuts.csv that was edited by hand.
    """
    _require_ct()
    edges = [] if voxel is None else [_length(voxel)] if isinstance(voxel, (str, float, int)) else [*map(_length, voxel)]
    known = _fraction(air_voids, "air_voids"), _fraction(aggregate, "aggregate")
    return _core.segment(fspath(images), fspath(out), edges, dataset, region, slices, rings, hardening, denoise, *known,
                         memory, None if smallest is None else _length(smallest), _path(gradation), _path(cuts),
                         recipe, facets, threads, progress)


def phantom(scene: _core.Scene | Mapping[str, Any] | Path, voxel: Length, out: Path, *, sawn: Length = 0,
            air: Length = "1 mm", specimen_seed: int | None = None, **spec: Any) -> _core.Phantom:
    """Writes a synthetic scan of a scene's specimen, and the true phases and grains, into `out`: `macadam ct phantom`.

    voxel: edge length of a voxel. sawn: thickness removed from each side of the box before it is scanned. air:
    thickness of the air around the specimen. specimen_seed: replaces the scene's seed.
    spec: seed, shape ("prism", "cylinder"), samples, blur [voxels], noise, cupping, rings, drift, grey_air,
    grey_mastic, grey_aggregate, progress; as the command's options.
    """
    _require_ct()
    spec |= {name: _fraction(spec[name], name) for name in ("noise", "cupping", "rings", "drift") if name in spec}
    given = _scene(scene) if specimen_seed is None else Scene(scene, seed=specimen_seed)
    return _core.phantom(given, _length(voxel), fspath(out), sawn=_length(sawn), air=_length(air), **spec)


def twin(folder: Path, scene: _core.Scene | Mapping[str, Any] | Path, out: Path, *, box: Sequence[Length] = (),
         porosity: Fraction | None = None, least_void: Length = 0, seed: int = 1,
         progress: Callable[[str, float], object] | None = None) -> _core.Twin:
    """Makes a scene that can be run from the specimen in a segmented scan and writes it to `out`/scene.toml: `macadam
    ct twin`.

    box: lower and upper corner in the scan, six lengths. porosity: porosity of the mastic's spheres. least_void: radius
    below which a void is left out; 0: two voxels.
    """
    _require_ct()
    return _core.twin(fspath(folder), _scene(scene), fspath(out), box=[*map(_length, box)],
                      porosity=_fraction(porosity, "porosity"), least_void=_length(least_void), seed=seed, progress=progress)
