#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Replaces PHANTOM/scan.mha by a scan that is reconstructed from simulated X-ray projections.

usage: projections.py PHANTOM [--angles 600] [--photons 3e4] [--seed 1]

PHANTOM is a folder of `macadam ct phantom` without faults (--blur 0 --noise 0 --cupping 0 --rings 0 --drift 0), so
that its grey values follow from the fractions of air, mastic and aggregate. Each slice is projected in a parallel
beam (ASTRA, on the CPU: pip install astra-toolbox), for photons of 20 to 140 keV of a tungsten tube behind 1 mm of
copper. Aggregate is limestone of 2.70 g/cm3; mastic is 3 parts of limestone and 1 part of bitumen by mass at 2.11
g/cm3. The detector counts photons (Poisson). Each of its pixels has its own gain, known to 0.2 % only, which causes
rings; the tube's focal spot blurs by a pixel. The slices are reconstructed by filtered back-projection of the
logarithms without any correction, so that beam hardening, rings, streaks and noise follow from the physics and not
from a formula."""
import argparse
import json
from pathlib import Path

import astra
import numpy as np
from compare import read_mha

KEV = np.arange(20.0, 140.0, 5.0)


def calcite(kev):
    """Returns the mass attenuation [cm2/g] from photoelectric and Compton terms. It agrees within a few per cent
    with NIST's table from 40 to 150 keV."""
    return 55000 / kev**3 + 0.14


def bitumen(kev):
    return 4000 / kev**3 + 0.175


def spectrum():
    """Returns the fraction of photons of each energy that the detector would count in air: Kramers' law and the
    filter."""
    copper = 3.1e5 / KEV**3 + 0.12
    counts = (140 - KEV) / KEV * np.exp(-copper * 8.96 * 0.1)
    return counts / counts.sum()


def shares(grey, levels):
    """Returns the fractions of mastic and of aggregate in each voxel."""
    aggregate = np.clip((grey - levels["mastic"]) / (levels["aggregate"] - levels["mastic"]), 0, 1)
    air = np.clip((levels["mastic"] - grey) / (levels["mastic"] - levels["air"]), 0, 1)
    return 1 - aggregate - air, aggregate


def blurred(rows):
    """Blurs by a focal spot of about a pixel: weights 1, 2, 1 along the detector."""
    padded = np.pad(rows, ((0, 0), (1, 1)), mode="edge")
    return 0.25 * padded[:, :-2] + 0.5 * padded[:, 1:-1] + 0.25 * padded[:, 2:]


class Scanner:
    def __init__(self, shape, voxel_cm, angles, photons, random):
        self.volume = astra.create_vol_geom(*shape)
        wide = int(np.ceil(1.5 * max(shape)))
        self.beam = astra.create_proj_geom("parallel", 1.0, wide, np.linspace(0, np.pi, angles, False))
        self.projector = astra.create_projector("linear", self.beam, self.volume)
        self.voxel, self.photons, self.random = voxel_cm, photons, random
        self.gain = 1 + 0.002 * random.standard_normal(wide)
        self.spectrum = spectrum()
        self.mastic, self.aggregate = 2.11 * (0.25 * bitumen(KEV) + 0.75 * calcite(KEV)), 2.70 * calcite(KEV)

    def lengths(self, share):
        number, sinogram = astra.create_sino(share, self.projector)
        astra.data2d.delete(number)
        return sinogram * self.voxel

    def slice(self, mastic, aggregate):
        a, b = self.lengths(mastic), self.lengths(aggregate)
        seen = sum(s * np.exp(-m * a - n * b) for s, m, n in zip(self.spectrum, self.mastic, self.aggregate))
        counts = np.maximum(self.random.poisson(self.photons * blurred(seen)), 1) / self.photons * self.gain
        sinogram = astra.data2d.create("-sino", self.beam, -np.log(counts))
        image = astra.data2d.create("-vol", self.volume)
        how = astra.astra_dict("FBP")
        how.update(ProjectorId=self.projector, ProjectionDataId=sinogram, ReconstructionDataId=image)
        algorithm = astra.algorithm.create(how)
        astra.algorithm.run(algorithm)
        found = astra.data2d.get(image) / self.voxel
        astra.algorithm.delete(algorithm)
        astra.data2d.delete([sinogram, image])
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("phantom", type=Path)
    parser.add_argument("--angles", type=int, default=600)
    parser.add_argument("--photons", type=float, default=3e4)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    file = arguments.phantom / "scan.mha"
    made = json.loads((arguments.phantom / "phantom.json").read_text(encoding="utf-8"))
    grey, _ = read_mha(file)
    mastic, aggregate = shares(grey.astype(np.float32), made["grey"])
    scanner = Scanner(grey.shape[1:], made["voxel_m"] * 100, arguments.angles, arguments.photons,
                      np.random.default_rng(arguments.seed))
    found = np.stack([scanner.slice(m, a) for m, a in zip(mastic, aggregate)])
    # 16 bit: air is at about 8000, limestone at 60 keV at about 40000
    grey = np.clip(np.round(8000 + 30000 * found), 0, 65535).astype("<u2")
    head = file.read_bytes().split(b"ElementDataFile", 1)[0].decode()
    n = grey.shape
    lines = [line for line in head.splitlines() if line.split("=")[0].strip() in (
        "ObjectType", "NDims", "BinaryData", "BinaryDataByteOrderMSB", "TransformMatrix", "Offset", "CenterOfRotation",
        "AnatomicalOrientation", "ElementSpacing")]
    lines += ["CompressedData = False", f"DimSize = {n[2]} {n[1]} {n[0]}", "ElementType = MET_USHORT",
              "ElementDataFile = LOCAL"]
    file.write_bytes(("\n".join(lines) + "\n").encode() + grey.tobytes())


if __name__ == "__main__":
    main()
