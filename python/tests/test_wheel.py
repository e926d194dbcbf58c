# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that a wheel needs is listed and has a licence. No wheel is built for these tests."""
import ast
import ctypes
import importlib
import re
import shutil
import subprocess
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


def loaded(script):
    """Loads a Python script of scripts/ as a module."""
    module = ModuleType(script.replace("-", "_"))
    SourceFileLoader(module.__name__, str(ROOT / "scripts" / script)).exec_module(module)
    return module


@pytest.fixture(scope="module")
def licences():
    return loaded("wheel-licences")


@pytest.fixture(scope="module")
def older():
    return loaded("older-symbols")


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


@pytest.mark.parametrize("part", ["", "mcp", "mixture", "report", "study"])
def test_every_module_that_is_imported_is_a_dependency(part):
    """The extra `report` need not list packages that only pictures of fields or the view need; `fields` and `view` do."""
    folder = ROOT / "python" / "macadam" / part
    project = PROJECT["project"]
    extras = project["optional-dependencies"]
    listed = named(project["dependencies"]) | named(extras.get(part, []))
    if part == "report":
        listed |= named(extras["fields"]) | named(extras["view"]) | {"vtkmodules"}  # PyVista's own dependency
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


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """Compiles a library that asks for hypot and, for its version's name in the file, for another symbol of libm."""
    if not shutil.which("g++"):
        pytest.skip("no g++")
    folder = tmp_path_factory.mktemp("older")
    (folder / "length.cpp").write_text('''#include <cmath>
extern "C" double length(double x, double y) { return hypot(x, y) + 0 * std::floor(x); }
''')
    subprocess.run(["g++", "-O0", "-fno-builtin", "-shared", "-fPIC", "-o", folder / "length.so", folder / "length.cpp"], check=True)
    return folder / "length.so"


def test_older_versions_are_asked_for(older, library, tmp_path, capsys):
    """The changed library loads and computes the same."""
    copy = Path(shutil.copy(library, tmp_path))
    versions = {need.version for need in older.Elf("length", copy.read_bytes()).needs()}
    if "GLIBC_2.35" not in versions:
        pytest.skip("a glibc before 2.35: hypot has no newer version")
    assert any("found GLIBC_2.35 of libm.so.6 (hypot), expected at most GLIBC_2.34" in m for m in older.main(["--check", str(copy)]))
    assert copy.read_bytes() == library.read_bytes()
    assert older.main([str(copy)]) == []
    assert "hypot asks for GLIBC_2.2.5 in place of GLIBC_2.35" in capsys.readouterr().out
    assert "GLIBC_2.35" not in {need.version for need in older.Elf("length", copy.read_bytes()).needs()}
    assert older.main([str(copy)]) == [] and not capsys.readouterr().out  # nothing is left to change
    length = ctypes.CDLL(str(copy)).length
    length.argtypes, length.restype = [ctypes.c_double, ctypes.c_double], ctypes.c_double
    assert length(3, 4) == 5


def test_an_unknown_symbol_keeps_its_version(older, library, monkeypatch):
    """A version is changed only if all symbols that have it are known to be the same under the older one."""
    monkeypatch.setattr(older, "OLDER", {version: (to, set()) for version, (to, _) in older.OLDER.items()})
    elf = older.Elf("length", library.read_bytes())
    assert elf.make_older() == [] and elf.data == library.read_bytes()


def test_other_files_are_refused(older, tmp_path):
    (tmp_path / "text.so").write_text("no library")
    with pytest.raises(ValueError, match=r"text\.so: found b'no lib', expected a little-endian ELF file of 64 bits"):
        older.main([str(tmp_path / "text.so")])


def test_hashes_of_versions(older):
    """The expected values are stored in libraries that the linker has made (objdump -p prints them)."""
    assert older.elf_hash("GLIBC_2.2.5") == 0x09691A75
    assert older.elf_hash("GLIBCXX_3.4.11") == 0x0297F861
