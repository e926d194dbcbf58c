# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that a wheel needs is listed and has a licence. No wheel is built for these tests."""
import ast
import importlib
import re
import shutil
import sys
import tomllib
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType

import pytest
from conftest import PROGRAM, ROOT

import macadam as mc
from macadam import _core

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
DEPENDENCIES = (ROOT / "scripts" / "dependencies").read_text()


@pytest.fixture(scope="module")
def licences():
    """Loads scripts/wheel-licences as a module."""
    module = ModuleType("wheel_licences")
    SourceFileLoader("wheel_licences", str(ROOT / "scripts" / "wheel-licences")).exec_module(module)
    return module


def imports_of(files):
    for file in files:
        for node in ast.walk(ast.parse(file.read_text())):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else \
                [node.module] if isinstance(node, ast.ImportFrom) and not node.level and node.module else []
            for name in names:
                yield name.split(".")[0]


def named(requirements):
    """Returns the projects that the requirements name, spelt like modules."""
    return {re.match(r"[A-Za-z0-9_.-]+", text)[0].replace("-", "_").lower() for text in requirements}


@pytest.mark.parametrize("part", ["", "mixture", "report", "study"])
def test_every_module_that_is_imported_is_a_dependency(part):
    """The extra `report` need not list packages that only pictures of fields need; the extra `fields` does."""
    folder = ROOT / "python" / "macadam" / part
    project = PROJECT["project"]
    extras = project["optional-dependencies"]
    listed = named(project["dependencies"]) | named(extras.get(part, []))
    if part == "report":
        listed |= named(extras["fields"]) | {"vtkmodules"}  # PyVista's own dependency
    foreign = set(imports_of(folder.glob("*.py"))) - set(sys.stdlib_module_names) - {"macadam", "__future__"}
    assert foreign <= listed, f"{foreign - listed}: not in pyproject.toml"


def test_every_file_of_bindings_is_compiled():
    lists = (ROOT / "python" / "CMakeLists.txt").read_text()
    assert {f"src/{f.name}" for f in (ROOT / "python" / "src").glob("*.cpp")} <= set(re.findall(r"src/\w+\.cpp", lists))


def test_every_script_that_the_program_starts_is_in_a_wheel():
    lists = (ROOT / "python" / "CMakeLists.txt").read_text()
    started = {name for f in (ROOT / "host" / "cli").rglob("*.cpp") for name in re.findall(r'draw_results\("([\w-]+)"', f.read_text())}
    assert started and all(f"scripts/{name}" in lists for name in started)


def test_every_library_has_a_licence(licences, tmp_path):
    if not shutil.which("dpkg-query") or not shutil.which("ldd"):
        pytest.skip("no Debian")
    binaries = [Path(_core.__file__)] + [Path(p) for p in [PROGRAM] if p]
    found = {}
    for binary in binaries:
        found |= licences.needed(binary)
    own = {name for name in found if name.startswith(("libmacadam", "libpython"))}
    assert own, "the module does not ask for the library"
    if "site-packages" in str(binaries[0]):
        pytest.skip("a wheel's libraries have names of their own")
    for name in sorted(set(found) - own - licences.OF_THE_SYSTEM):
        package, version, licence = licences.licence_of(name, [])
        assert version and licence.stat().st_size > 100, name
    assert not [name for name in found if licences.NOT_IN_WHEELS.search(name)]
    with pytest.raises(LookupError, match=r"libnone\.so\.1: found no licence"):
        licences.licence_of("libnone.so.1", [tmp_path])
    for name, package, _, licence in licences.compiled_in([]):
        assert licence.is_file(), name
        assert package in ("nanobind", "libboost1.74-dev", "libfmt-dev") or package in DEPENDENCIES, package


def test_names_that_auditwheel_gives_are_taken_back(licences):
    assert licences.plain_name("macadam.libs/libgomp-a34b3233.so.1.0.0") == "libgomp.so.1.0.0"
    assert licences.plain_name("libITKCommon-5-15084a0b.2.so.1") == "libITKCommon-5.2.so.1"
    assert licences.plain_name("libmpfr.so.6") == "libmpfr.so.6"
    assert licences.NOT_IN_WHEELS.search("libcudart-12345678.so.12") and not licences.NOT_IN_WHEELS.search("libceres.so.3")


def test_the_version_is_one(monkeypatch):
    table = PROJECT["tool"]["scikit-build"]["metadata"]["version"]
    monkeypatch.syspath_prepend(ROOT / table["provider-path"])
    asked = importlib.import_module(table["provider"]).dynamic_metadata("version", {}, {})
    assert asked.split("+")[0] == mc.__version__.split("+")[0]
