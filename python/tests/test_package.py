# SPDX-License-Identifier: GPL-3.0-or-later
"""The package itself: it loads names lazily, is typed, and works together with the program."""
import os
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import macadam as mc

SOURCE = ROOT / "python"


def test_every_name_is_there_and_documented():
    for name in mc.__all__:
        if name in ("mixture", "report", "study") and not (SOURCE / "macadam" / name).exists():
            continue
        assert getattr(mc, name) is not None
        assert getattr(mc, name).__doc__, name
    number = subprocess.run([ROOT / "scripts" / "version", "--number"], capture_output=True, text=True, check=True).stdout
    # after the + comes the commit from which the program was built
    assert mc.__version__.split("+")[0] == number.strip()
    assert set(mc.__all__) <= set(dir(mc))
    with pytest.raises(AttributeError, match="harmonics"):
        mc.harmonics  # noqa: B018


def test_dir_has_the_names_of_the_package_alone():
    names = {name for name in dir(mc) if not name.startswith("__")}
    assert names == {*mc.__all__, "InterruptedError"} - {"__version__"}
    code = "from macadam import *; assert InterruptedError is __builtins__.InterruptedError; print(Scene.__name__)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "Scene\n"


def test_the_package_is_imported_where_the_library_is_not(tmp_path):
    code = "import macadam, sys; assert 'macadam._core' not in sys.modules; print(macadam.__doc__.split(':')[0])"
    said = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(SOURCE)}, text=True, check=True,
                          capture_output=True, cwd=tmp_path)
    assert said.stdout.strip() == "Macadam"


def test_types_are_right():
    pytest.importorskip("mypy")
    here = Path(mc.__file__).parent
    said = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--allow-any-generics", "--no-warn-return-any",
                           "--disable-error-code", "import-untyped", "--no-error-summary", "--cache-dir", os.devnull, "-p",
                           "macadam", "--exclude", "mcp|mixture|report|study"], cwd=here.parent, capture_output=True, text=True)
    own = [line for line in said.stdout.splitlines() if not re.search("macadam/(mcp|mixture|report|study)", line)]
    assert not own, "\n".join(own)


def test_a_users_script_is_checked(tmp_path):
    pytest.importorskip("mypy")
    script = (SOURCE / "tests" / "user_script.py").read_text()
    wrong = script.replace("stepper.advance(10)", 'stepper.advance("ten")')
    said = {}
    for name, text in (("right", script), ("wrong", wrong)):
        (tmp_path / f"{name}.py").write_text(text)
        said[name] = subprocess.run([sys.executable, "-m", "mypy", "--disable-error-code", "import-untyped", "--cache-dir",
                                     os.devnull, f"{name}.py"], cwd=tmp_path, capture_output=True, text=True,
                                    env={**os.environ, "MYPYPATH": str(Path(mc.__file__).parent.parent)})
    here = [line for line in said["right"].stdout.splitlines() if line.startswith("right.py")]
    assert not here, "\n".join(here)
    assert 'wrong.py' in said["wrong"].stdout and '"advance"' in said["wrong"].stdout


def test_help_has_units():
    for function, units in ((mc.run, ("[s]", "[Pa]")), (mc.harmonic, ("[Hz]", "[°C]")), (mc.creep, ("[Pa]", "[s]", "[kg]")),
                            (mc.monotonic, ("[1/s]",)), (mc.specimen, ("[m]",)), (mc.Stepper, ("[s]", "[1/s]"))):
        text = pydoc.render_doc(function)
        assert all(unit in text for unit in units), function


def fake(tmp_path, name):
    """Writes a package macadam whose command prints its arguments."""
    folder = tmp_path / "fake" / "macadam" / name
    folder.mkdir(parents=True)
    (folder.parent / "__init__.py").touch()
    (folder.parent / "__main__.py").write_text("import os, sys; print('told', sys.argv[1:], os.environ['MACADAM_PROGRAM'])")
    (folder / "__init__.py").touch()
    return folder.parents[1]


@pytest.mark.parametrize("name", ["mcp", "mixture", "report", "study"])
def test_the_program_hands_on_what_is_python(name, tmp_path, program):
    """A program without a package beside it starts the Python that MACADAM_PYTHON names, and passes on all
    arguments."""
    alone = tmp_path / "bin" / "macadam"
    alone.parent.mkdir()
    alone.symlink_to(program)  # /proc/self/exe is the real file, beside which the program finds its own package
    python = tmp_path / "python"
    python.write_text(f"#!/bin/sh\nPYTHONPATH={fake(tmp_path, name)} exec {sys.executable} \"$@\"\n")
    python.chmod(0o755)
    environment = {**os.environ, "MACADAM_PYTHON": str(python)}
    environment.pop("MACADAM_PROGRAM", None)
    said = subprocess.run([alone, name, "DIR", "--out", "a b", "--help"], env=environment, capture_output=True, text=True,
                          cwd=tmp_path)
    # The Python command gets the path of the program that was called.
    told = f"told ['{name}', 'DIR', '--out', 'a b', '--help'] {Path(program).resolve()}\n"
    assert (said.returncode, said.stdout) == (0, told), said.stderr
    python.write_text(f"#!/bin/sh\nPYTHONPATH={tmp_path} exec {sys.executable} -S \"$@\"\n")
    said = subprocess.run([alone, name], env={**os.environ, "MACADAM_PYTHON": str(python)}, capture_output=True, text=True,
                          cwd=tmp_path)
    assert said.returncode == 2 and f"macadam {name}: found no Python package" in said.stderr
    said = subprocess.run([alone, name], env={**os.environ, "MACADAM_PYTHON": "/no/python"}, capture_output=True, text=True,
                          cwd=tmp_path)
    assert said.returncode == 2 and "/no/python" in said.stderr and "MACADAM_PYTHON" in said.stderr


@pytest.mark.parametrize("name", ["mcp", "mixture", "report", "study"])
def test_a_python_without_the_packages_is_told_apart(name, tmp_path, program):
    """The message names the missing packages, the Python and the way to install them. It is not a traceback."""
    python = tmp_path / "python"
    python.write_text(f"#!/bin/sh\nexec {sys.executable} -S \"$@\"\n")  # -S: Python without its site-packages
    python.chmod(0o755)
    said = subprocess.run([program, name, "DIR"], env={**os.environ, "MACADAM_PYTHON": str(python)}, capture_output=True, text=True)
    assert said.returncode == 2 and "Traceback" not in said.stderr
    assert f"macadam {name}: " in said.stderr and "numpy, pandas, matplotlib" in said.stderr
    assert "scripts/python report" in said.stderr and "MACADAM_PYTHON" in said.stderr


def test_the_package_hands_on_what_is_the_programs(program):
    said = subprocess.run([sys.executable, "-m", "macadam", "info"], capture_output=True, text=True, check=True)
    assert said.stdout == subprocess.run([program, "info"], capture_output=True, text=True, check=True).stdout
    said = subprocess.run([sys.executable, "-m", "macadam", "runs"], capture_output=True, text=True)
    assert said.returncode == 2 and 'found "runs"' in said.stderr


@pytest.mark.parametrize("level", ["x86-64", "x86-64-v3", "x86-64-v4"])
def test_code_of_every_generation_finds_the_same(level, small_file, specimen):
    """A build for this machine only (native) has code for one processor, and ignores MACADAM_PROCESSOR."""
    code = (f"import macadam as mc; s = {str(small_file)!r}; print(mc.info()['processor'], mc.harmonic(s, frequencies=[10]).table.e_star_pa[0],"
            "mc.run(s, loading={'frequencies': [20.0]}).table.e_star_pa[0])")
    said = subprocess.run([sys.executable, "-c", code], env={**os.environ, "MACADAM_PROCESSOR": level}, capture_output=True,
                          text=True, check=True)
    name, solved, stepped = said.stdout.split()
    own = mc.info()["processor"]
    assert name == own == "native" or name == min(level, own)
    assert float(solved) == pytest.approx(mc.harmonic(specimen, frequencies=[10]).table.e_star_pa[0], rel=1e-9)  # the solver's tolerance
    # The scene's tolerance leads to single precision. The run itself estimates the error of single
    # precision to be below 1e-5
    assert float(stepped) == pytest.approx(mc.run(specimen, loading={"frequencies": [20.0]}).table.e_star_pa[0], rel=1e-5)


@pytest.mark.parametrize("given, spins", [({}, "'0'"), ({"GOMP_SPINCOUNT": "7"}, "'7'")])
def test_waiting_threads_sleep_unless_the_user_says_otherwise(given, spins):
    bare = {k: v for k, v in os.environ.items() if k not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")}
    said = subprocess.run([sys.executable, "-c", "import macadam; macadam.info()"], capture_output=True, text=True, check=True,
                          env={**bare, "OMP_DISPLAY_ENV": "verbose", **given}).stderr
    if "GOMP_SPINCOUNT" not in said:
        pytest.skip("this OpenMP does not report it")
    assert f"GOMP_SPINCOUNT = {spins}" in said
