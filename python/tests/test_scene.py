# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes from files and dictionaries, overrides, and errors with the command's messages."""
import subprocess
import tomllib

import numpy as np
import pytest
from conftest import DEMO

import macadam as mc
from macadam import _toml


def test_a_file_is_read_as_it_is():
    scene = mc.Scene(DEMO)
    assert scene.text == DEMO.read_text()
    assert (scene.kind, scene.method, scene.seed) == ("cyclic", "explicit", 1)
    assert scene.frequencies == [2, 5, 10, 20]
    assert scene.box == (0.02, 0.02, 0.03)


def test_a_dictionary_is_the_same_scene():
    tables = tomllib.loads(DEMO.read_text())
    scene = mc.Scene(tables)
    assert scene.as_dict() == tables
    assert scene.frequencies == mc.Scene(DEMO).frequencies


@pytest.mark.parametrize("values", [
    {"a": 1, "b": 2.0, "c": "x\"\\\n\t°", "d": True, "e": [1.5, 2e-9, float("inf")], "f": {"g": [], "h.i": -3}},
    {"t": [{"a": [1, 2], "u": [{"b": 1e300}, {"b": 0.1}]}, {"a": ["x"]}], "m": [[1, 2], [3]]},
])
def test_toml_goes_there_and_back(values):
    assert tomllib.loads(_toml.dumps(values)) == values


def test_numpy_and_paths_are_values(tmp_path):
    assert tomllib.loads(_toml.dumps({"a": np.array([1.0, 2.5]), "b": np.float64(0.1), "c": np.int64(3), "d": tmp_path,
                                      "e": None})) == {"a": [1.0, 2.5], "b": 0.1, "c": 3, "d": str(tmp_path)}
    with pytest.raises(TypeError, match="set"):
        _toml.dumps({"a": {1, 2}})


def test_overrides_of_every_depth():
    scene = mc.Scene(DEMO, seed=7, backend="cpu", method="harmonic", loading={"frequencies": [1.0]},
                     **{"contacts.M-A.delta": 2, "specimen.aggregate.1.volume_fraction": 0.1, "solver.tolerance": None})
    tables = scene.as_dict()
    assert (scene.seed, scene.backend, scene.method, scene.frequencies) == (7, "cpu", "harmonic", [1])
    assert [c.get("delta") for c in tables["contacts"]] == [None, 2, None, None, None]
    assert tables["specimen"]["aggregate"][1]["volume_fraction"] == 0.1
    assert "tolerance" not in tables["solver"]
    again = mc.Scene(scene, loading={"strain_amplitude": 1e-5})
    assert (again.seed, again.method, again.frequencies) == (7, "harmonic", [1])
    assert mc.Scene(again).options == again.options == {"seed": 7, "backend": "cpu", "method": "harmonic"}
    assert mc.Scene(DEMO).seed == 1


def test_paths_are_relative_to_the_file(tmp_path, specimen):
    specimen.write(tmp_path / "specimen.csv")
    tables = {**mc.Scene(DEMO).as_dict(), "specimen": {"file": "specimen.csv", "box": list(specimen.box)}}
    assert len(mc.specimen(mc.Scene(tables, file=tmp_path / "any.toml"))) == len(specimen)
    with pytest.raises(mc.InputError, match="specimen.csv"):
        mc.specimen(mc.Scene(tables, file=tmp_path / "elsewhere" / "any.toml"))


@pytest.mark.parametrize(("change", "message"), [
    ({"loading.frequencis": [1]}, r'frequencis.*frequencies'),
    ({"loading.frequencies": [-1]}, r"frequencies.*-1.*positive"),
    ({"specimen.box": ["1 kg", 1, 1]}, r'box.*"1 kg"'),
    ({"contacts.M-X.delta": 1}, r"'M-X', expected the position of an entry, from 0 to 4, or one of M-M, M-A"),
    ({"loading.kind.x": 1}, r"'cyclic' at loading.kind, expected a section"),
    ({"backend": "gpu"}, r'backend: found "gpu", expected one of auto\|cuda\|cpu\|reference'),
    ({"frequencies": [1]}, r"\[frequencies\]: found an unknown section, expected one of specimen, "),
    ({"loadng": {}}, r"\[loadng\]: found an unknown section, expected loading \(the nearest of specimen, "),
    ({"threads": 0}, r"threads: found 0, expected a whole number from 1 to 1024"),
])
def test_what_is_wrong_is_named_without_lines_that_nobody_wrote(change, message):
    with pytest.raises(mc.InputError, match=message) as caught:
        mc.Scene(DEMO, **change)
    assert "scene.toml:" + "1" not in str(caught.value)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, mc.Error)


FAULTS = {"no section": "[specimen]\n", "syntax": "[specimen\n", "empty": "",
          "unknown key": DEMO.read_text().replace("porosity", "porositi"),
          "seed": DEMO.read_text().replace("seed = 1 ", "seed = -1 ")}


@pytest.mark.parametrize("fault", FAULTS)
def test_messages_are_those_of_the_command(fault, tmp_path, program):
    file = tmp_path / "scene.toml"
    file.write_text(FAULTS[fault])
    said = subprocess.run([program, "run", file, "--out", tmp_path / "out"], capture_output=True, text=True)
    assert said.returncode == 2
    with pytest.raises(mc.InputError) as caught:
        mc.Scene(file)
    assert said.stderr.strip() == f"macadam: {caught.value}"


def test_no_file(tmp_path):
    for overrides in ({}, {"loading.cycles": 2}):
        with pytest.raises(mc.InputError, match="no such file"):
            mc.Scene(tmp_path / "none.toml", **overrides)
