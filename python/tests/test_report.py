# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports: the page of every kind of result folder shows the folder's contents; a wrong folder raises an error that
names it."""

from __future__ import annotations

import importlib.util
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import macadam.report.__main__ as command
from macadam.report import ReportError, cracks, mixture, report, specimen
from report_folders import ENVIRONMENT, PROGRAM, ROOT, make
from report_folders import command as run_as

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")

CASES = {
    "stepped": [
        "Decided by the program",
        "the last cycle computed with time steps",
        "Error bars",
        "geometry update",
        "stepping",
    ],
    "harmonic": [
        "Cole–Cole",
        "Black diagram",
        "Loops of the steady state",
        "Sensitivity of the result",
        "median area",
    ],
    "temperatures": ["Master curve of", "shift a_T", "φ in degrees at 3 temperatures"],
    "relaxation": ["Relaxation", "the modulus falls from", "Prony series", "prony_abaqus.inp"],
    "creep": ["Creep", "is left at", "a step of stress (right)"],
    "monotonic": ["Constant rate of strain", "compression at", "secant modulus"],
    "stepped_relaxation": ["Relaxation", "the modulus falls from", "Error bars of stepped points", "density scaling 100"],
    "stepped_creep": ["is left at 6.00 ms", "the error is above 1 %", "until 3.00 ms (dotted)", "or an estimate of this difference: at most 47 %"],
    "stepped_monotonic": ["Constant rate of strain", "compression at 10,000 µm/m per second", "secant modulus goes from"],
    "broken": ["Strength of ", "the largest stress (cross) is", "The specimen broke between t = ", "Broken contact points: "],
    "cracked": [
        "Strength of ",
        ", work of fracture ",
        "Cracks and energies",
        "the energies into which it was converted, stacked",
        "facets in it that have begun to crack",
        "facets whose mean damage is above 0.5",
        "The sum of the energies differs from the work by at most",
    ],
    "confined": ["The sides are held", "confined"],
    "recipe": [
        "Gradation of",
        "voids in the mineral aggregate",
        "no test was run",
        "Cells as the program cut them",
        "The curve leaves the envelope at 2.00 mm",
    ],
    "voids": ["Air voids are white", "air voids with cells"],
    "file": ["the specimen comes from a file"],
    "calibration": ["Measured (dots) and predicted (lines)", "M-A.delta"],
    "fit": ["Measured (dots) and fitted (lines)", "Kelvin 1"],
    "shapes": ["Statistics over all shapes"],
}


@pytest.fixture
def no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Switches off the pictures of specimens, which take most of the time of a report."""
    monkeypatch.setattr(specimen, "MOST", 0)


@pytest.mark.parametrize("kind", CASES)
def test_every_kind_of_folder(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if kind not in ("recipe", "voids"):  # pictures of the specimen take most of the time of a report
        monkeypatch.setattr(specimen, "MOST", 0)
    out = report(make(kind), tmp_path / "report.html")
    page = out.read_text(encoding="utf-8")
    plain = re.sub(r"data:[^\"]*", "", page)
    for words in CASES[kind]:
        assert words in re.sub(r"<[^>]*>", "", plain) or words in plain, words
    # the page loads nothing and runs no script
    assert "<script" not in plain and "http" not in plain.replace("http-equiv", "")
    assert not re.search(r">[^<]*\b(nan|None|inf)\b", plain), "a missing value is shown as a number"
    assert list(tmp_path.iterdir()) == [out]


def test_cells_of_a_plane_are_those_of_least_power_distance() -> None:
    """Compares the cells in a plane with a search over all particles at every point. The cases include very large
    spheres, and gaps far from any sphere."""
    draw = np.random.default_rng(5)
    for number, least, most in ((300, 0.4, 0.6), (40, 0.01, 3.0), (3, 0.1, 0.2)):
        centre = draw.uniform([0, 0, -5], [10, 12, 5], (number, 3))
        radius = draw.uniform(least, most, number)
        u, v = np.linspace(0, 10, 41), np.linspace(0, 12, 53)
        at = np.stack(np.broadcast_arrays(u[None, :], v[:, None], 0.0), axis=-1)
        power = ((at[:, :, None] - centre) ** 2).sum(axis=-1) - radius**2
        assert np.array_equal(specimen.cells_at(u, v, centre, radius), power.argmin(axis=-1))


def test_discs_cut_a_plane_in_chords() -> None:
    """A disc in the plane x = 0 with radius 2 and centre at a distance of 1 from the plane y = 3 has a chord of length
    2·√3 along z. A disc parallel to the plane has no chord, and neither has a disc that is farther away than its radius."""
    centre = np.array([[0.0, 2, 5], [0, 3, 0], [0, 0.9, 0]])
    normal = np.array([[1.0, 0, 0], [0, 1, 0], [1, 0, 0]])
    cuts, lines = cracks.chords(centre, normal, np.full(3, 4 * np.pi), 1, 3.0)
    assert cuts.tolist() == [0]
    ends = lines[0][np.argsort(lines[0][:, 2])]
    # the numbers are of order 1, so that rounding is some 1e-16
    assert np.allclose(ends, [[0, 3, 5 - np.sqrt(3)], [0, 3, 5 + np.sqrt(3)]], rtol=0, atol=1e-14)


def test_discs_have_the_area_and_normal_of_their_facets() -> None:
    normal = np.array([[0.0, 0, 1], [0.6, 0, 0.8], [-1, 0, 0]])
    centre, area = np.arange(9.0).reshape(3, 3), np.array([1.0, 2, 3])
    polygons = cracks.discs(centre, normal, area)
    assert np.allclose(polygons.mean(axis=1), centre, rtol=0, atol=1e-12)
    arms = polygons - centre[:, None]
    assert np.allclose(np.einsum("nci,ni->nc", arms, normal), 0, atol=1e-12)
    twice = np.cross(arms, np.roll(arms, -1, axis=1)).sum(axis=1)  # twice the area, along the normal
    assert np.allclose(0.5 * np.linalg.norm(twice, axis=1), area, rtol=1e-12)


def test_fields_are_drawn_by_pyvista(tmp_path: Path, no_pictures) -> None:
    pytest.importorskip("pyvista")
    folder = make("fields")
    plain = report(folder, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "Displacement (µm), particles_2Hz.vtkhdf; the front half is" in plain  # the lowest frequency
    assert "Normal force (N), contacts_2Hz.vtkhdf; those with at least" in plain
    copy = tmp_path / "cut"
    shutil.copytree(folder, copy)
    file = copy / "fields" / "contacts_2Hz.vtkhdf"
    file.write_bytes(file.read_bytes()[:1000])
    with pytest.raises(ReportError, match="contacts_2Hz.vtkhdf"):
        report(copy, tmp_path / "cut.html")


def test_fields_without_pyvista_are_left_out_and_that_is_said(tmp_path: Path, no_pictures, monkeypatch) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *a: None if name == "pyvista" else find(name, *a))
    assert "the Python package PyVista is not installed" in report(make("fields"), tmp_path / "r.html").read_text("utf-8")


def test_folders_side_by_side_have_names_and_a_table_of_differences(tmp_path: Path, no_pictures) -> None:
    folders = [make(kind) for kind in ("stepped", "harmonic", "confined")]
    plain = re.sub(r"<[^>]*>|data:[^\"]*", "", report(folders, tmp_path / "r.html").read_text(encoding="utf-8"))
    for name in ("stepped", "harmonic", "confined"):
        assert name in plain
    assert "|E*| to stepped (%)" in plain


def test_classes_of_several_mixes_stand_from_coarse_to_fine() -> None:
    names = ["4.75-9.5 mm", "2-4.75 mm", "mastic", "12.5-19 mm", "9.5-12.5 mm", "fibres"]
    ordered = ["12.5-19 mm", "9.5-12.5 mm", "4.75-9.5 mm", "2-4.75 mm", "mastic", "fibres"]
    assert mixture._from_coarse_to_fine(names) == ordered


def test_seeds_of_one_scene_have_a_mean_and_a_scatter(tmp_path: Path, no_pictures) -> None:
    folders = [make("harmonic", seed) for seed in (1, 2)]
    plain = report(folders, tmp_path / "r.html").read_text(encoding="utf-8")
    values = [json.loads((f / "summary.json").read_text())["results"][0]["e_star_pa"] for f in folders]
    scatter = abs(values[0] - values[1]) / 2**0.5 / (sum(values) / 2)
    assert "mean of 2 seeds" in plain
    said = re.search(r"standard deviation as bars; the deviation is ([\d.]+) % of", plain)
    assert said and float(said[1]) >= 0.98 * 100 * scatter  # the page shows the largest scatter of all frequencies


def test_seeds_have_a_table_of_mean_and_deviation(tmp_path: Path, no_pictures) -> None:
    folders = [make("harmonic", seed) for seed in (1, 2)]
    plain = report(folders, tmp_path / "r.html", figures=tmp_path / "figures").read_text(encoding="utf-8")
    e_star = np.array([[r["e_star_pa"] for r in json.loads((f / "summary.json").read_text())["results"]] for f in folders])
    means = pd.read_csv(tmp_path / "figures/means.csv")
    assert np.allclose(means.e_star_pa, e_star.mean(0), rtol=1e-14)
    assert np.allclose(means.e_star_deviation_pa, e_star.std(0, ddof=1), rtol=1e-9)
    assert "Mean of 2 seeds: mean ± standard deviation of single specimens." in plain
    assert f"{1e-9 * e_star.mean(0)[0]:.2f} ± " in plain  # four digits of some 11.5 GPa


def test_figures_are_written_in_every_form(tmp_path: Path) -> None:
    out = tmp_path / "figures"
    page = report(make("harmonic"), tmp_path / "r.html", figures=out).read_text(encoding="utf-8")
    names = sorted({p.stem for p in out.glob("figure-*")})
    assert len(names) == page.count("<figcaption>") and all((out / f"{n}.{end}").is_file() for n in names for end in ("svg", "pdf", "png"))
    for file in out.glob("*.png"):
        width = int.from_bytes(file.read_bytes()[16:20], "big")  # of a PNG's header
        assert abs(width - 1800) <= 1  # matplotlib rounds the width down
    assert (out / "captions.txt").read_text(encoding="utf-8").count("Figure ") >= len(names)
    table = pd.read_csv(next(out.glob("*e-and-phase-angle-over-frequency.csv")))
    results = json.loads((make("harmonic") / "summary.json").read_text())["results"]
    assert list(table[table.panel == 1].x) == [r["frequency_hz"] for r in results]
    assert np.allclose(table[table.panel == 1].y, [1e-9 * r["e_star_pa"] for r in results], rtol=1e-12)  # GPa
    assert len(pd.read_csv(out / "sensitivities.csv")) == sum(len(r["sensitivities"]) for r in results)
    bars = pd.read_csv(next(out.glob("*sensitivities-of-e-and-phase-angle.csv")))
    assert "M-A.E_m" in set(bars.name)


def test_the_methods_have_laws_scene_and_version(tmp_path: Path, no_pictures) -> None:
    page = report(make("harmonic"), tmp_path / "r.html").read_text(encoding="utf-8")
    version = json.loads((make("harmonic") / "summary.json").read_text())["macadam"]
    assert f"The computations were made with Macadam {version}." in page
    assert "E_m = 1.115e+10, C_m = 2.515e+09" in page and "The steady state was solved in the frequency domain" in page
    assert "[specimen.mastic]" in page and "was when this report was written" in page
    other = report(make("harmonic"), tmp_path / "s.html", scene="[specimen]\nbox = [1, 1, 1]\n").read_text(encoding="utf-8")
    assert "box = [1, 1, 1]" in other and "[specimen.mastic]" not in other


@pytest.mark.parametrize(
    ("example", "sizes", "words"),
    [
        ("indirect_tension", {'"60 mm"': '"30 mm"', 'thickness = "20 mm"': 'thickness = "12 mm"'}, "cyclic indirect tension"),
        ("bending", {'"100 mm"': '"60 mm"', '"16 mm"': '"12 mm"'}, "cyclic bending"),
        ("torsion", {'"24 mm"': '"12 mm"', '"40 mm"': '"16 mm"'}, "cyclic torsion"),
    ],
)
def test_the_methods_name_the_test(tmp_path: Path, no_pictures, example, sizes, words) -> None:
    scene = (ROOT / "examples" / example / "scene.toml").read_text(encoding="utf-8")
    for usual, small in sizes.items():
        assert usual in scene
        scene = scene.replace(usual, small)
    (tmp_path / "scene.toml").write_text(scene, encoding="utf-8")
    subprocess.run([PROGRAM, "run", tmp_path / "scene.toml", "--out", tmp_path / "out", "--backend", "cpu"], check=True,
                   capture_output=True)
    page = report(tmp_path / "out", tmp_path / "r.html").read_text(encoding="utf-8")
    assert f"computed in {words}" in page and "uniaxial" not in page
    symbol, other = ("|G*|", "|E*|") if example == "torsion" else ("|E*|", "|G*|")
    assert f"modulus {symbol} and phase angle" in page and other not in page


def test_the_methods_show_the_values_of_set(tmp_path: Path, no_pictures) -> None:
    folder = tmp_path / "changed"
    shutil.copytree(make("harmonic"), folder)
    summary = json.loads((folder / "summary.json").read_text())
    (folder / "summary.json").write_text(json.dumps(summary | {"set": ["contacts.M-A.delta=2"]}))
    page = report(folder, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "scene_as_run.toml is not there" in page
    (folder / "scene_as_run.toml").write_text('# delta\n[[contacts]]\npair = "M-A"\nlaw = "elastic"\ndelta = 2\n')
    page = report(folder, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "scene_as_run.toml: the scene file" in page and "delta = 2" in page


def test_folders_of_one_name_are_told_apart(tmp_path: Path, no_pictures) -> None:
    for parent in "ab":
        shutil.copytree(make("harmonic"), tmp_path / parent / "same")
    plain = report([tmp_path / "a/same", tmp_path / "b/same"], tmp_path / "r.html").read_text(encoding="utf-8")
    assert "a/same" in plain and "b/same" in plain


def test_what_is_missing_is_left_out_and_said(tmp_path: Path) -> None:
    folder = tmp_path / "part"
    shutil.copytree(make("harmonic"), folder)
    for name in ("specimen.csv", "aggregates.csv", "contacts.csv"):
        (folder / name).unlink()
    plain = report(folder, tmp_path / "r.html").read_text(encoding="utf-8")
    for words in ("no specimen.csv in the folder", "no contacts.csv", "no aggregates.csv"):
        assert words in plain


def test_text_of_files_is_text_of_the_page(tmp_path: Path, no_pictures) -> None:
    folder = tmp_path / "<b>x & y"
    shutil.copytree(make("file"), folder)
    summary = json.loads((folder / "summary.json").read_text())
    summary.update(status="failed: <script>alert(1)</script>", warnings=["a < b & c"])
    (folder / "summary.json").write_text(json.dumps(summary))
    page = report(folder, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<script>" not in page and "&lt;script&gt;" in page and "a &lt; b &amp; c" in page and "<b>x" not in page
    assert "This run is not complete".lower() in page.lower()


def _empty(folder: Path) -> None:
    pass


def _no_json(folder: Path) -> None:
    (folder / "summary.json").write_text("{")


def _other_json(folder: Path) -> None:
    (folder / "summary.json").write_text("[1]")


def _no_status(folder: Path) -> None:
    (folder / "summary.json").write_text("{}")


def _columns(folder: Path) -> None:
    (folder / "summary.json").write_text('{"status": "done", "results": []}')
    (folder / "specimen.csv").write_text("a,b\n1,2\n")


@pytest.mark.parametrize(
    "spoil, says",
    [
        (_empty, "not a results folder of macadam"),
        (_no_json, "summary.json: "),
        (_other_json, "found a list, expected an object"),
        (_no_status, "found no key \"status\""),
        (_columns, "specimen.csv: found the columns a, b; expected also x"),
    ],
)
def test_a_wrong_folder_is_an_error_of_exit_code_2(spoil, says: str, tmp_path: Path, capsys) -> None:
    folder = tmp_path / "wrong"
    folder.mkdir()
    spoil(folder)
    out = tmp_path / "r.html"
    assert command.main([str(folder), "--out", str(out)]) == 2
    error = capsys.readouterr().err
    assert str(folder) in error and says in error and "Traceback" not in error
    assert not out.exists() and not list(tmp_path.glob(".*"))


def test_other_wrong_requests(tmp_path: Path, capsys) -> None:
    folder = make("file")
    with pytest.raises(ReportError, match="no such folder"):
        report(tmp_path / "nowhere", tmp_path / "r.html")
    with pytest.raises(ReportError, match="found a file"):
        report(folder / "summary.json", tmp_path / "r.html")
    with pytest.raises(ReportError, match="given twice"):
        report([folder, folder], tmp_path / "r.html")
    with pytest.raises(ReportError, match="no result folder given"):
        report([], tmp_path / "r.html")
    with pytest.raises(ReportError, match="found a folder"):
        report(folder, tmp_path)
    (tmp_path / "file").write_text("")
    # exit code 1: the file cannot be written
    assert command.main([str(folder), "--out", str(tmp_path / "file/r.html")]) == 1
    assert "file" in capsys.readouterr().err


def test_commands_of_the_page(tmp_path: Path, no_pictures) -> None:
    """Runs every command and every line of Python of docs/report.md, in a folder that contains results with the names
    used on that page."""
    page = (ROOT / "docs/report.md").read_text(encoding="utf-8")
    shutil.copytree(make("stepped"), tmp_path / "results/demo")
    shutil.copytree(make("harmonic"), tmp_path / "results/harmonic")
    code = [line[4:] for line in page.splitlines() if line.startswith("    ")]
    commands = [line for line in code if line.startswith("macadam ")]
    assert len(commands) == 4 and len(code) == 7
    if importlib.util.find_spec("k3d") is None:
        commands = [line for line in commands if "--view" not in line]
    for line in commands:
        subprocess.run(run_as(line), cwd=tmp_path, check=True, env=ENVIRONMENT)
    for name in ("report.html", "both.html"):
        assert (tmp_path / name).is_file()
        (tmp_path / name).unlink()
    program = "\n".join(line for line in code if not line.startswith("macadam "))
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True, env=ENVIRONMENT)
    assert (tmp_path / "report.html").is_file() and "Stepped and harmonic" in (tmp_path / "both.html").read_text(
        "utf-8"
    )


def test_a_test_in_time_without_a_drawing_of_its_own_gets_the_general_one(tmp_path: Path, no_pictures) -> None:
    copy = shutil.copytree(make("relaxation"), tmp_path / "copy")
    summary = json.loads((copy / "summary.json").read_text("utf-8"))
    summary["results"][0]["kind"] = "torsion"
    (copy / "summary.json").write_text(json.dumps(summary), "utf-8")
    plain = report(copy, tmp_path / "r.html").read_text("utf-8")
    assert "Torsion</h2>" in plain and "Strain (left) and stress (right) over time" in plain and "Test: torsion." in plain
    for point in summary["results"][0]["points"]:
        del point["stress_pa"]
    (copy / "summary.json").write_text(json.dumps(summary), "utf-8")
    with pytest.raises(ReportError, match="test torsion: found points without stress_pa, expected time_s"):
        report(copy, tmp_path / "r.html")


BENT = {
    "semicircular_bending": ("""
        domain = "half_disc"
        diameter = 0.021
        thickness = 0.005
        notch = [{ axis = "x", at = 0.0105, z = [0, 0.002] }]
        """, ["Bending strength", "Semicircular bending"]),
    "three_point_bending": ("""
        domain = "beam"
        length = 0.04
        width = 0.005
        height = 0.008
        notch = [{ axis = "x", at = 0.02, z = [0, 0.002] }]
        """, ["Fracture toughness", "Three-point bending"]),
}


@pytest.mark.parametrize("kind", BENT)
def test_a_bent_specimen_has_the_results_of_its_standard(kind: str, tmp_path: Path, no_pictures) -> None:
    specimen, expected = BENT[kind]
    crack = "crack = { tensile_strength = 1e6, fracture_energy = 50, shear_strength = 1.5e6, friction = 0.5 }"
    (tmp_path / "scene.toml").write_text(
        f"""
        contacts = [{{ pair = "M-M", law = "elastic", E = 5e9, alpha = 0.3, {crack} }},
          {{ pair = "M-W", law = "elastic", E = 5e9 }}]
        [specimen]
        {specimen}
        mastic = {{ radius = [0.0009, 0.0011], porosity = 0.05 }}
        [materials]
        aggregate = {{ density = 2000 }}
        mastic = {{ density = 2000 }}
        [loading]
        kind = "{kind}"
        rate = "50 mm/min"
        roller_width = "1.5 mm"
        displacement = "0.2 mm"
        points = 20
        [solver]
        tolerance = 1e-2
        """,
        encoding="utf-8",
    )
    subprocess.run([PROGRAM, "run", tmp_path / "scene.toml", "--out", tmp_path / "out", "--backend", "cpu"], check=True,
                   capture_output=True)
    page = report(tmp_path / "out", tmp_path / "r.html").read_text(encoding="utf-8")
    assert all(words in page for words in [*expected, "fracture energy", "largest load", "Load over the approach"])
    assert f"{kind}, with" not in page


def test_a_specimen_that_cools_has_its_fracture(tmp_path: Path, no_pictures) -> None:
    """The stress of the column grows by 20 kPa per kelvin and reaches the strength at 10 °C; then it falls."""
    crack = "crack = { tensile_strength = 2e5, shear_strength = 2e5, fracture_energy = 2 }"
    (tmp_path / "column.csv").write_text(
        "id,x,y,z,radius,phase,body\n0,0.005,0.005,0.005,0.005,mastic,-1\n1,0.005,0.005,0.015,0.005,mastic,-1\n", "utf-8"
    )
    (tmp_path / "scene.toml").write_text(
        f"""
        contacts = [{{ pair = "M-M", law = "elastic", E = 1e9, alpha = 0.3, {crack} }},
          {{ pair = "M-W", law = "elastic", E = 1e9, alpha = 0.3 }}]
        [specimen]
        file = "column.csv"
        box = [0.01, 0.01, 0.02]
        [materials]
        mastic = {{ density = 2000, expansion = 2e-5 }}
        [loading]
        kind = "cooling"
        to = -12
        points = 16
        """,
        encoding="utf-8",
    )
    command = [PROGRAM, "run", tmp_path / "scene.toml", "--backend", "cpu"]
    subprocess.run([*command, "--out", tmp_path / "broken"], check=True, capture_output=True)
    page = report(tmp_path / "broken", tmp_path / "r.html").read_text(encoding="utf-8")
    assert "Fracture at 10.0 °C under a thermal stress of 200 kPa" in page
    assert "Thermal stress while cooling" in page and "fracture (cross) at 10.0 °C under 200 kPa" in page
    subprocess.run([*command, "--set", "loading.to=12", "--out", tmp_path / "whole"], check=True, capture_output=True)
    page = report(tmp_path / "whole", tmp_path / "r.html").read_text(encoding="utf-8")
    assert "not broken; largest thermal stress 160 kPa at 12.0 °C" in page and "did not break" in page
