# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipes in packaging/ agree with the lists of dependencies. No image and no conda package is built for these tests."""
import csv
import re
import tomllib
from importlib.machinery import SourceFileLoader
from types import ModuleType

import pytest
from conftest import ROOT

PACKAGING = ROOT / "packaging"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
EXTRAS = PROJECT["project"]["optional-dependencies"]
#: Debian package -> conda-forge package of the same library. None: a tool that conda-build brings or does not need.
CONDA_NAMES = {
    "g++": None, "ccache": None, "cmake": "cmake", "ninja-build": "ninja", "libcgal-dev": "cgal-cpp", "libboost-dev": "libboost-devel",
    "libgmp-dev": "gmp", "libeigen3-dev": "eigen", "libceres-dev": "ceres-solver", "libsuitesparse-dev": "suitesparse",
    "libmetis-dev": "metis", "libopenblas-dev": "libblas", "zlib1g-dev": "zlib", "libhdf5-dev": "hdf5", "libfmt-dev": "fmt",
    "nlohmann-json3-dev": "nlohmann_json", "libtomlplusplus-dev": "tomlplusplus", "libcli11-dev": "cli11",
    "libinsighttoolkit5-dev": "libitk-devel",
}
#: Name in find_package() -> conda-forge package
CMAKE_NAMES = {"CGAL": "cgal-cpp", "Boost": "libboost-devel", "Eigen3": "eigen", "fmt": "fmt", "nlohmann_json": "nlohmann_json",
               "tomlplusplus": "tomlplusplus", "CLI11": "cli11", "ITK": "libitk-devel"}
#: Column of bench/results/distributions.csv -> conda-forge package
TESTED_NAMES = {"cgal": "cgal-cpp", "hdf5": "hdf5", "itk": "libitk-devel", "fmt": "fmt"}


def version(text):
    return tuple(int(part) for part in text.split("."))


@pytest.fixture(scope="module")
def recipe():
    """Returns the requirements of the conda recipe: section -> package -> {'>=': version, '<': version}."""
    found, section = {}, None
    text = (PACKAGING / "conda" / "meta.yaml").read_text()
    for line in text[text.index("\nrequirements:"):text.index("\ntest:")].splitlines():
        if m := re.fullmatch(r"  (\w+):", line):
            section = found.setdefault(m[1], {})
        elif m := re.fullmatch(r"    - ([a-z0-9_-]+)(?: (\S+))?(?:  #.*)?", line):
            section[m[1]] = {sign: version(number) for sign, number in re.findall(r"(>=|<)([\d.]+)", m[2] or "")}
        else:
            assert not line.strip() or line in ("requirements:",) or "{{" in line, f"found '{line}', expected a requirement"
    return found


@pytest.fixture(scope="module")
def images():
    module = ModuleType("image_check")
    module.__file__ = str(ROOT / "scripts" / "image-check")
    SourceFileLoader("image_check", module.__file__).exec_module(module)
    return module


def test_the_conda_recipe_has_every_library(recipe):
    rows = csv.DictReader(line for line in (ROOT / "scripts" / "supply.csv").read_text().splitlines() if not line.startswith("#"))
    packages = {row["package"] for row in rows if row["list"] in ("build", "ct")}
    assert packages == set(CONDA_NAMES), "scripts/supply.csv and the names in this test differ"
    assert {name for name in CONDA_NAMES.values() if name} <= set(recipe["host"]) | set(recipe["build"])


def test_the_conda_recipe_asks_for_what_cmake_asks_for(recipe):
    asked = dict(re.findall(r"find_package\((\w+) ([\d.]+)", (ROOT / "cmake" / "dependencies.cmake").read_text()))
    assert set(asked) - {"Python"} == set(CMAKE_NAMES)
    for name, package in CMAKE_NAMES.items():
        assert recipe["host"][package][">="] == version(asked[name]), package


def test_the_conda_recipe_asks_for_what_the_python_package_asks_for(recipe):
    project, build = PROJECT["project"], PROJECT["build-system"]["requires"]
    asked = {name: version(number) for name, number in (re.fullmatch(r"([\w-]+)>=([\d.]+)", text).groups() for text in project["dependencies"])}
    assert {name: bounds[">="] for name, bounds in recipe["run"].items() if name != "python"} == asked
    for name, number in (re.fullmatch(r"([\w-]+)>=([\d.]+)", text).groups() for text in build):
        assert recipe["host"][name][">="] == version(number)
    python = version(project["requires-python"].removeprefix(">="))
    assert recipe["host"]["python"][">="] == recipe["run"]["python"][">="] == python
    assert recipe["build"]["cmake"][">="] == version(PROJECT["tool"]["scikit-build"]["cmake"]["version"].removeprefix(">="))


def test_the_conda_recipe_allows_the_tested_versions(recipe):
    """Debian 12's versions (scripts/supply.csv) and those that scripts/chroot-build has tested."""
    rows = list(csv.DictReader((ROOT / "bench" / "results" / "distributions.csv").read_text().splitlines()))
    tested = [(package, version(row[column])) for row in rows for column, package in TESTED_NAMES.items()]
    supply = csv.DictReader(line for line in (ROOT / "scripts" / "supply.csv").read_text().splitlines() if not line.startswith("#"))
    tested += [(CONDA_NAMES[row["package"]], version(row["version"])) for row in supply if CONDA_NAMES.get(row["package"])
               and row["list"] in ("build", "ct")]
    for package, number in tested:
        bounds = recipe["host"].get(package, {})
        assert bounds.get(">=", (0,)) <= number and number < bounds.get("<", (1000,)), f"{package} {number} is outside of {bounds}"


def test_the_conda_recipe_has_the_version_of_the_newest_release():
    newest = re.search(r"^## \[(\d+\.\d+\.\d+)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)[1]
    assert f'environ.get("MACADAM_VERSION", "{newest}")' in (PACKAGING / "conda" / "meta.yaml").read_text()


def test_both_images_are_the_same(images):
    docker = images.docker_image((PACKAGING / "Dockerfile").read_text())
    apptainer = images.apptainer_image((PACKAGING / "apptainer.def").read_text())
    assert docker.base == apptainer.base == "debian:bookworm-slim", "the wheel is made and tested on Debian 12"
    assert (docker.path, docker.start) == (apptainer.path, apptainer.start)
    assert docker.commands == apptainer.commands
    assert [to for _, to in docker.copies] == [to for _, to in apptainer.copies]
    extras = re.search(r"\.whl\)\[([\w,]+)\]", " ".join(docker.commands))[1].split(",")
    assert set(extras) <= set(EXTRAS)


def test_the_image_is_made_of_what_exists(images):
    """The first stage calls scripts that are in the tree, and the build context has the sources and the history."""
    for word, argument in images.instructions((PACKAGING / "Dockerfile").read_text()):
        if word == "RUN":
            for path in re.findall(r"/macadam/(scripts/\S+)", argument):
                assert (ROOT / path).is_file(), path
    left_out = (PACKAGING / "Dockerfile.dockerignore").read_text().split("\n")
    assert {line for line in left_out if line and not line.startswith("#")} == {"/build", "/results"}
    with pytest.raises(ValueError, match="found the instruction 'ADD'"):
        list(images.instructions("FROM a\nADD b c\n"))
