# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/aggregate-cube.md, from aggregate-cube.csv of bench/shapes/run-cube, which has one row per cube."""
from pages.data import between, half_range, mean, minus, rows, table, upto_percent, where
from pages.marks import mark

DOCUMENT = "docs/aggregate-cube.md"
TARGET, WALL = 60.0, 115.1  # moduli of the rock and of the paper's walls [GPa]
GROUPS = [(s, f) for s in ("fine", "coarse") for f in ("shape", "recipe")]


# Returns the rows of cubes with these properties; edge in mm, wall in GPa.
def cubes(spheres, filling, seeds=3, porosity=0.0, edge=20.0, wall=WALL, sides="free"):
    return where(rows("aggregate-cube.csv"), spheres=spheres, filling=filling, porosity=porosity, edge_mm=edge,
                 wall_gpa=wall, sides=sides, seed=lambda s: s <= seeds)


def of(found, key):
    return mean(r[f"{key}_gpa"] for r in found)


def cell(found, key):
    return f"{of(found, key):.2f} ± {half_range(r[f'{key}_gpa'] for r in found):.2f}"


def over(found, key):
    return 100 * (of(found, key) / TARGET - 1)


def deviation(found, key):
    return minus(f"{over(found, key):+.1f} %")


def number(found):
    return f"{mean(r['number'] for r in found):.0f}"


def ratio(found):
    return f"{mean(r['poisson'] for r in found):.3f}"


@mark
def headline():
    lines = []
    for group in GROUPS:
        c = cubes(*group, seeds=20)
        lines.append((*group, number(c), cell(c, "walls"), deviation(c, "walls"), cell(c, "gauge"),
                      deviation(c, "gauge"), ratio(c), f"{of(c, 'uniform_strain'):.2f}", cell(c, "contact_for_walls"),
                      cell(c, "contact_for_gauge")))
    return table(["spheres", "filling", "number", "walls (GPa)", "to 60", "gauge (GPa)", "to 60", "Poisson's ratio",
                  "uniform strain (GPa)", "E for 60 by walls (GPa)", "E for 60 by gauge (GPa)"], lines, range(2, 11))


POROSITIES = (0.0, 0.05, 0.12, 0.20)


@mark
def porosities():
    lines = []
    for group in GROUPS:
        for porosity in POROSITIES:
            c = cubes(*group, porosity=porosity)
            lines.append((*group, f"{porosity:.2f}", number(c), cell(c, "walls"), cell(c, "gauge"),
                          deviation(c, "gauge")))
    return table(["spheres", "filling", "porosity", "number", "walls (GPa)", "gauge (GPa)", "to 60"], lines,
                 range(2, 7))


@mark
def boundaries():
    lines = []
    for group in GROUPS:
        rigid = cubes(*group, wall=1e6)
        lines.append((*group, cell(cubes(*group, wall=TARGET), "walls"), cell(cubes(*group), "walls"),
                      cell(rigid, "walls"), cell(rigid, "gauge"), cell(cubes(*group, sides="held"), "walls")))
    return table(["spheres", "filling", "A-W 60 GPa", "A-W 115.1 GPa", "rigid A-W", "rigid A-W: gauge",
                  "four sides held too, 115.1 GPa"], lines, range(2, 7))


@mark
def edges():
    lines = []
    for filling in ("shape", "recipe"):
        for edge in (15.0, 20.0, 30.0, 40.0):
            c = cubes("coarse", filling, edge=edge)
            lines.append((filling, f"{edge:.0f}", number(c), cell(c, "walls"), cell(c, "gauge"), deviation(c, "gauge"),
                          ratio(c)))
    return table(["filling", "edge (mm)", "number", "walls (GPa)", "gauge (GPa)", "to 60", "Poisson's ratio"], lines,
                 range(1, 7))


# ---- numbers of the text

@mark
def gauge(spheres, filling):
    return f"{of(cubes(spheres, filling, 20), 'gauge'):.1f}"


@mark
def gauge_off(spheres, filling):
    return deviation(cubes(spheres, filling, 20), "gauge").replace(" ", " ")


@mark
def one_cube_off():
    """Returns the largest deviation from 60 GPa of all cubes, measured by gauge."""
    return upto_percent(abs(r["gauge_gpa"] / TARGET - 1) for g in GROUPS for r in cubes(*g, seeds=20))


@mark
def uniform(spheres):
    return f"{of(cubes(spheres, 'shape', 20), 'uniform_strain'):.1f}"


@mark
def walls_over(spheres):
    return between([over(cubes(spheres, f, 20), "walls") for f in ("shape", "recipe")]) + " %"


@mark
def contact(spheres, key):
    return between([of(cubes(spheres, f, 20), f"contact_for_{key}") for f in ("shape", "recipe")], "{:.1f}")


@mark
def soft_walls():
    """Returns the largest deviation of the modulus by walls of 60 GPa from the modulus by gauge with the paper's walls,
    %."""
    return upto_percent(abs(of(cubes(*g, wall=TARGET), "walls") / of(cubes(*g), "gauge") - 1) for g in GROUPS)


@mark
def rigid_walls():
    return between([over(cubes(*g, wall=1e6), "walls") for g in GROUPS]) + " %"


@mark
def porosity_matters():
    """Returns the largest change caused by porosity, measured by gauge or by walls, %."""
    return upto_percent(abs(of(cubes(*g, porosity=p), key) / of(cubes(*g), key) - 1)
                        for g in GROUPS for p in POROSITIES for key in ("walls", "gauge"))


@mark
def large():
    return between([of(cubes("coarse", f, edge=40.0), "gauge") for f in ("shape", "recipe")], "{:.1f}")


@mark
def below_uniform():
    """Returns by how much the modulus of the largest cubes is below that for uniform strain, %."""
    c = [cubes("coarse", f, edge=40.0) for f in ("shape", "recipe")]
    return between([100 * (1 - of(x, "gauge") / of(x, "uniform_strain")) for x in c], "{:.1f}") + " %"
