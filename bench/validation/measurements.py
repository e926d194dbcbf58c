# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what the laboratory measured of a lane from the workbooks of bench/validation/run."""
import csv

import numpy as np
import openpyxl

MIXTURES = "polymer_modified.xlsx"
BINDERS = "rutting_binder.xlsx"
FORMULAS = "ra_modified.xlsx"


def rows_of(folder, workbook, sheet):
    """Returns the rows of a sheet."""
    return list(openpyxl.load_workbook(folder / workbook, data_only=True)[sheet].iter_rows(values_only=True))


def write_binder(folder, lane, file):
    """Writes the first replicate of the recovered binder's frequency sweep as the CSV file of a design."""
    rows = rows_of(folder, BINDERS, "Binder Frequency Sweep")
    column = next(k for k, title in enumerate(rows[0]) if str(title).startswith(f"Lane {lane} (recovered 0-Month"))
    with open(file, "w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out)
        writer.writerow(["temperature_c", "omega_rad_s", "g_star_pa", "phase_deg"])
        writer.writerows(r[column : column + 4] for r in rows[3:] if isinstance(r[column], (int, float)))


def binder_strength(folder, lane):
    """Returns the net tensile strength [Pa] and the essential work of fracture [J/m2] of the recovered binder: mean of
    the double-edge notched tension tests with the shortest ligament, and the intercept of work per area over ligament."""
    tests = [r for r in rows_of(folder, MIXTURES, "DENT")[2:] if r[0] == lane and r[1] == "0-Month"]
    strength = float(np.mean([r[8] / r[12] for r in tests]))
    ligaments = np.array([r[9:12] for r in tests], float).ravel()
    work = np.array([np.array(r[5:8], float) / np.array(r[12:15], float) for r in tests]).ravel()
    return strength, float(np.polyfit(ligaments, work, 1)[1])


def gradation(folder, lane):
    """Returns pairs of sieve [m] and fraction passing of the mixture as produced."""
    rows = rows_of(folder, MIXTURES, "Gradation")
    column = next(k for k, title in enumerate(rows[1]) if title == f"Lane {lane}" and k >= 4)
    found = [(r[1] / 1e3, r[column] / 100) for r in rows[2:] if isinstance(r[column], (int, float)) and r[1] <= 19]
    # aggregate above 19 mm counts as finer, because the coarsest sieve of a recipe passes everything
    return [[sieve, 1.0 if sieve >= 0.019 else part] for sieve, part in found]


def formula(folder):
    """Returns binder content (of the mix), maximum density and aggregate density [kg/m3] of the control mixture (20RAP)
    as designed. The lanes' own binder contents are not published; they share the designed gradation with it."""
    rows = {r[0]: r for r in rows_of(folder, FORMULAS, "JMF")}
    column = next(k for k, title in enumerate(rows[None]) if title == "20RAP")
    binder, maximum = rows["Pb (%)"][column] / 100, rows["Gmm"][column] * 1e3
    air, vma = rows[" Va at Ndes (%)"][column] / 100, rows["VMA (%)"][column] / 100
    return binder, maximum, maximum * (1 - air) * (1 - binder) / (1 - vma)


def ideal_ct(folder, lane):
    """Returns the measured results of the short-term aged discs of a lane, one dictionary per disc, in SI units."""
    rows = rows_of(folder, MIXTURES, "IDEAL-CT")
    return [{"peak_load_n": r[6] * 1e3, "displacement_at_peak_m": r[7] / 1e3, "work_j": r[15],
             "l85_m": r[11] / 1e3, "l75_m": r[12] / 1e3, "l65_m": r[13] / 1e3, "m75_n_m": r[14] * 1e6, "fracture_energy_j_m2": r[17], "ct_index": r[5],
             "thickness_m": r[18] / 1e3, "diameter_m": r[19] / 1e3}
            for r in rows[1:] if r[0] == lane and r[2] == "STOA"]
