# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's printed numbers: Table 3 (composition), Table 5 (contacts), Fig. 11 (|E*| and phi), and values that
follow from them alone. Used by bench/paper/paper-specimens and bench/paper/paper_variants."""
import math
from dataclasses import dataclass

BOX = 0.05 * 0.05 * 0.08  # m3
CLASSES = ["12.5–19", "9.5–12.5", "4.75–9.5", "2.0–4.75", "mastic"]
FREQUENCIES = [2, 5, 10, 20]
PAIRS = ["A-A", "M-A", "M-M"]
FINE, COARSE, MASTIC = (0.75e-3, 1.00e-3), (1.00e-3, 2.00e-3), (0.75e-3, 1.00e-3)  # radii of the spheres [m]
DESIGN = ("ac14_ms_design", [14.0, 11.0, 20.7, 13.6, 40.7])  # % of the solid volume, by class


def mean_sphere(radius):
    """Returns the mean volume of spheres whose radii are uniformly distributed in a range [m3]."""
    low, high = radius
    return math.pi / 3 * (high**4 - low**4) / (high - low)


@dataclass
class Specimen:
    """The paper's numbers of one specimen. Lists by size class: particles, spheres, mean L^I in mm, share of all
    spheres' volume in %."""
    scene: str
    radius: tuple | None  # range of radii of the spheres of a cluster [m]; None: no clusters
    particles: list
    spheres: list
    size: list
    share: list
    contacts: list  # numbers of contacts A-A, M-A, M-M, total
    coordination: float

    @property
    def to_box(self):
        """The volume of all spheres divided by the volume of the box, if the mastic's radii are uniform."""
        # the printed shares are rounded; the mastic has the remainder to 100 %, as in the scenes
        return self.volume(4) / (1 - sum(self.share[:4]) / 100)

    def volume(self, k):
        """Returns the volume of the spheres of a class divided by the volume of the box."""
        return self.particles[4] * mean_sphere(MASTIC) / BOX if k == 4 else self.share[k] / 100 * self.to_box

    def sphere(self, k):
        """Returns the mean volume of a sphere of a class [m3]."""
        return self.volume(k) * BOX / self.spheres[k]

    @property
    def clustered(self):
        """Classes with aggregates of more than one sphere."""
        return [k for k in range(4) if self.spheres[k] > self.particles[k]]

    @property
    def void_of_mastic(self):
        """The fraction of void in the clusters, if aggregates and mastic together have the same volume as in SS."""
        clusters = sum(self.volume(k) for k in self.clustered)
        single = sum(self.volume(k) for k in range(4)) - clusters
        return 1 - clusters / (PAPER["SS"].to_box - self.volume(4) - single)


PAPER = {
    "SS": Specimen(
        "ac14_ss_am1", None, [12, 27, 184, 1373, 34164], [12, 27, 184, 1373, 34164],
        [15.6, 10.8, 6.8, 3.1, 1.7], [12.6, 9.1, 17.0, 13.2, 48.1], [2177, 55451, 154222, 211851], 5.92),
    "MS-Poly-coarse": Specimen(
        "ac14_ms_poly_coarse", COARSE, [12, 32, 225, 1159, 32660], [1533, 1198, 1705, 1159, 32660],
        [14.8, 10.2, 6.9, 3.3, 1.7], [11.4, 8.5, 16.0, 13.7, 50.4], [4014, 73731, 144390, 222135], 6.52),
    "MS-Poly-fine": Specimen(
        "ac14_ms_poly_fine", FINE, [14, 31, 264, 1298, 32809], [7944, 6283, 11737, 4177, 32809],
        [15.0, 10.5, 6.2, 3.8, 1.7], [12.2, 9.4, 17.1, 12.3, 48.9], [9902, 130989, 138699, 279592], 8.12),
    "MS-Ico-coarse": Specimen(
        "ac14_ms_ico_coarse", COARSE, [14, 33, 264, 1352, 31159], [1662, 1250, 1624, 1352, 31159],
        [15.5, 10.8, 7.1, 3.2, 1.7], [11.9, 8.8, 16.5, 13.9, 48.8], [3875, 74180, 135092, 213147], 6.49),
    "MS-Ico-fine": Specimen(
        "ac14_ms_ico_fine", FINE, [16, 30, 258, 1434, 31790], [8546, 6620, 12387, 4357, 31790],
        [14.9, 11.2, 6.5, 3.9, 1.7], [12.6, 9.6, 17.6, 12.4, 47.7], [8788, 126088, 134849, 269728], 8.04),
}
CLUSTERS = list(PAPER)[1:]
# Fig. 11, numbers from the paper's text: mean deviation from SS over the frequencies, of |E*| and of phi in %
DEVIATION = {"MS-Poly-coarse": (19, -18), "MS-Poly-fine": (33, -31),
             "MS-Ico-coarse": (19, -18), "MS-Ico-fine": (34, -29)}
# Section 4.4: delta of M-M contacts, and the rock
DELTA_MM = {"AM1": 1.88, "AM2": 1.90}
ROCK = {"E": 60.0, "nu": 0.28}  # GPa
# Figs. 12 and 13: delta_MA with which each specimen has the |E*| of SS, by mix
DELTA_MA = {"AM1": {"SS": 3.15, "MS-Poly-coarse": 1.68, "MS-Ico-coarse": 1.68, "MS-Poly-fine": 1.00,
                    "MS-Ico-fine": 1.00},
            "AM2": {"SS": 6.75, "MS-Poly-coarse": 3.20, "MS-Poly-fine": 1.70}}
# Mean deviations from SS with these delta_MA, in %, over the specimens: of |E*| (for AM1 its magnitude), of phi
CALIBRATED = {"AM1": ("3", (-16, 15)), "AM2": ("between −3 and +3", (-8, 23))}
# Deviation of Ico from Poly, %; the paper says "essentially identical" for the coarse filling
ICO_OVER_POLY = {"coarse": (0, 0), "fine": (0.8, 2.3)}
