# SPDX-License-Identifier: GPL-3.0-or-later
"""The checks of bench/fracture/run. Each takes a Bench and whether to compute only a small part, and returns the rows
of its table. docs/fracture-verification.md has the formulas."""
import math

from lattice import MODULUS, SPACING, STRENGTH, box, crack, notch, spheres, strain_before_drop

KEYS = 'kind = "{}"\nrate = 0.01\n{} = {!r}\npoints = {}\n'

STRIPS = (2.0, 4.0, 8.0)  # fracture energies of the strips [J/m2]
NOTCHES = (4, 6, 8, 12, 16)  # half lengths of the notches of the plates, in spacings
WIDTHS = (8, 16, 32, 64)  # half widths of the similar plates, in spacings
# width of the strips over the diameter of the disc, and shear strength over tensile strength
DISCS = ((0.08, 4.0), (0.08, 8.0), (0.127, 4.0), (0.2, 4.0))
DEPTHS = (6, 8, 10, 12)  # of the notches of the half discs, in spacings


def strip(bench, quick):
    """A long strip between rigid platens with a notch in the middle of its height (Rivlin and Thomas). E' is stress
    over strain of the strip without a notch."""
    (centres, width, height), table = spheres(72, 24), []
    whole = bench.run("modulus", box(width, height), KEYS.format("monotonic", "strain", 1e-4, 2), centres=centres)
    modulus = float(whole["rows"][0]["secant_pa"])
    for energy in STRIPS[1:2] if quick else STRIPS:
        stress = math.sqrt(2 * modulus * energy / height)
        result = bench.run("strip", box(width, height),
                           KEYS.format("monotonic", "strain", 1.5 * stress / modulus, 50), crack(energy),
                           notch("z", height / 2, f"x = [0, {width / 3!r}]"), centres)
        ligament = SPACING * width * 2 / 3
        table.append(bench.row(
            result, height_mm=height * 1e3, fracture_energy_j_m2=energy, modulus_pa=modulus, stress_theory_pa=stress,
            stress_pa=modulus * strain_before_drop(result),
            dissipated_j_m2=float(result["rows"][-1]["crack_energy_j"]) / ligament))
    return table


def plate(bench, width, length, energy):
    """Returns the result of half a plate with a central notch: a row of equal notches in one line, because smooth side
    walls are planes of symmetry. width: of the half, length: of the half notch, both in spacings. Adds the stress that
    theory predicts and a factor: K = stress x factor."""
    centres, wide, high = spheres(width, 2 * width)
    factor = math.sqrt(2 * wide * math.tan(math.pi * length / (2 * width)))
    stress = math.sqrt(MODULUS * energy) / factor
    strain = 1.5 * min(stress, STRENGTH * (1 - length / width)) / MODULUS
    result = bench.run("plate", box(wide, high), KEYS.format("monotonic", "strain", strain, 30), crack(energy),
                       notch("z", high / 2, f"x = [0, {length * SPACING!r}]"), centres, walls=True)
    return result, stress, factor


def griffith(bench, quick):
    """A plate with central notches of several lengths and a small cohesive zone."""
    width, energy, table = 24 if quick else 40, 1.0, []
    for length in (4, 8) if quick else NOTCHES:
        result, stress, factor = plate(bench, width, length, energy)
        table.append(bench.row(result, width_mm=width * SPACING * 1e3, notch_mm=length * SPACING * 1e3,
                               fracture_energy_j_m2=energy, strength_theory_pa=stress,
                               strength_pa=result["strength_pa"],
                               toughness_pa_sqrt_m=result["strength_pa"] * factor))
    return table


def size(bench, quick):
    """Plates of similar shape, whose half notch is a quarter of half their width (size effect of Bazant)."""
    energy, table = 2.0, []
    for width in WIDTHS[:3] if quick else WIDTHS:
        result, stress, _ = plate(bench, width, width // 4, energy)
        ligament = (width - width // 4) * SPACING * SPACING
        table.append(bench.row(result, width_mm=width * SPACING * 1e3, fracture_energy_j_m2=energy,
                               strength_theory_pa=stress, strength_pa=result["strength_pa"],
                               dissipated_j_m2=float(result["rows"][-1]["crack_energy_j"]) / ligament))
    return table


def disc(bench, quick):
    """A disc between two strips of several widths."""
    across, energy, table = 40, 2.0, []
    diameter = across * SPACING
    centres = [(x, z) for x, z in spheres(across, across)[0]
               if math.hypot(x - diameter / 2, z - diameter / 2) < diameter / 2 - 0.1 * SPACING]
    for part, shear in DISCS[2:3] if quick else DISCS:
        result = bench.run("disc", f'domain = "disc"\ndiameter = {diameter!r}\nthickness = {SPACING!r}',
                           KEYS.format("indirect_tensile_strength", "displacement", 6.5e-3 * diameter, 40)
                           + f"strip_width = {part * diameter!r}", crack(energy, shear), centres=centres)
        table.append(bench.row(result, diameter_mm=diameter * 1e3, strip_width=part, shear_over_tension=shear,
                               fracture_energy_j_m2=energy, strength_theory_pa=STRENGTH * (1 - part**2)**-1.5,
                               strength_pa=result["indirect_tensile_strength_pa"]))
    return table


def half_disc(bench, quick):
    """A half disc on rollers with notches of several depths."""
    across, energy, table = 60, 2.0, []
    radius = across * SPACING / 2
    centres = [(x, z) for x, z in spheres(across, across // 2)[0]
               if math.hypot(x - radius, z) < radius - 0.1 * SPACING]
    for depth in DEPTHS[1:2] if quick else DEPTHS:
        part = depth * SPACING / radius
        shape = 4.782 - 1.219 * part + 0.063 * math.exp(7.045 * part)
        load = math.sqrt(MODULUS * energy / (math.pi * depth * SPACING)) * 2 * radius * SPACING / shape
        result = bench.run("half-disc", f'domain = "half_disc"\ndiameter = {2 * radius!r}\nthickness = {SPACING!r}',
                           KEYS.format("semicircular_bending", "displacement", 40 * load / (MODULUS * SPACING), 40),
                           crack(energy, 4.0), notch("x", radius, f"z = [0, {depth * SPACING!r}]"), centres)
        table.append(bench.row(result, diameter_mm=2e3 * radius, notch_mm=depth * SPACING * 1e3,
                               fracture_energy_j_m2=energy, load_theory_n=load, load_n=result["peak_load_n"],
                               work_j_m2=result["fracture_energy_j_m2"], last_load=result["last_load_part"]))
    return table


CHECKS = {"strip": strip, "griffith": griffith, "size": size, "disc": disc, "half-disc": half_disc}
