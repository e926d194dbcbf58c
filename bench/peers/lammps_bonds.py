# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes LAMMPS input files that step given spheres and bonds.

Every contact between two particles becomes an unbreakable bond of style `bpm/rotational` with normal, shear,
bending and twisting stiffness. There is no search for contacts: no pair style is set."""
import csv
import math
import random

COMMANDS = """units si
atom_style bpm/sphere
newton on off
boundary f f f
special_bonds lj 0 1 1 coul 1 1 1
comm_modify cutoff {longest:.9g} vel yes
read_data {data}
bond_style bpm/rotational break no smooth no
bond_coeff 1 1e6 1e6 1 1 1 1 1 1 0 0 0 0
fix motion all nve/bpm/sphere
timestep 1e-9
thermo 1000000
run 5
{runs}
"""


def rows(path):
    with open(path, encoding="utf-8") as f:
        yield from csv.DictReader(line for line in f if not line.startswith("#"))


def write_input(specimen, contacts, folder, runs=7, steps=10):
    """Writes LAMMPS's commands for `runs` runs of `steps` steps each. Returns their path and the number of bonds."""
    spheres = [(*(float(row[k]) for k in "xyz"), float(row["radius"])) for row in rows(specimen)]
    bonds = [(int(row["a"]), int(row["b"])) for row in rows(contacts) if int(row["b"]) >= 0]
    random.seed(1)
    data, commands = folder / "bonds.data", folder / "bonds.in"
    with open(data, "w", encoding="utf-8") as out:
        out.write(f"bonds between spheres\n\n{len(spheres)} atoms\n{len(bonds)} bonds\n1 atom types\n1 bond types\n")
        for axis, name in enumerate("xyz"):
            low, high = (f(s[axis] for s in spheres) for f in (min, max))
            out.write(f"{low - 0.01} {high + 0.01} {name}lo {name}hi\n")
        out.write("\nAtoms\n\n")
        out.writelines(f"{n} 1 1 {2 * r} 2500 {x} {y} {z}\n" for n, (x, y, z, r) in enumerate(spheres, 1))
        out.write("\nVelocities\n\n")
        for n in range(len(spheres)):
            speeds = [random.uniform(-limit, limit) for limit in 3 * [1e-6] + 3 * [1e-4]]
            out.write(" ".join(map(str, [n + 1, *speeds])) + "\n")
        out.write("\nBonds\n\n")
        out.writelines(f"{n} 1 {a + 1} {b + 1}\n" for n, (a, b) in enumerate(bonds, 1))
    longest = max(math.dist(spheres[a][:3], spheres[b][:3]) for a, b in bonds)
    commands.write_text(COMMANDS.format(longest=1.01 * longest, data=data, runs="\n".join(runs * [f"run {steps}"])), encoding="utf-8")
    return commands, len(bonds)
