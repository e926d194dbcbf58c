# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged study files are either read or refused with a StudyError; there is no other exception and no endless loop.
The changes are random with fixed seeds; a fuzzer for Python, as libFuzzer is for C++, would be one more package to
install."""

from __future__ import annotations

import random
import time
from pathlib import Path

from macadam.study.design import read_design
from macadam.study.errors import StudyError

SCENE = """[specimen]
box = [0.01, 0.01, 0.01]
seed = 1
[[specimen.aggregate]]
volume_fraction = 0.1
[[contacts]]
pair = "M-M"
delta = 1.0
[loading]
kind = "sweep"
"""
LAW = """[[contacts]]
pair = "M-M"
law = "elastic"
E = 1e9
"""
STUDY = """scene = "scene.toml"
command = "run"
arguments = ["--threads", 1]
[grid]
specimen.seed = [1, 2]
"contacts.M-M.delta" = [1.0, 2.0]
[[list]]
loading.kind = "creep"
[choice.mix.a]
"specimen.aggregate.0.volume_fraction" = 0.2
[choice.mix.b]
file = "law.toml"
[experiment.cold]
"loading.temperatures" = [0, 10]
[run]
on = "here"
[report]
frequency = 10
"""
WORDS = ["1", "-1", "1e308", "nan", "[]", "{}", "[[]]", "true", '""', '"a"', "'x.y'", "[1]", "{ a = 1 }", "grid", "list", "choice",
         "experiment", "[grid]", "[[list]]", "[choice]", "[choice.mix]", "[run]", "[report]", "[[contacts]]", "contacts", "file",
         "scene", "=", ".", "..", '"specimen"', '"contacts.M-M"', '"specimen.aggregate.9"', "[" * 2000, "\x00", "\udc80", "9" * 5000,
         "1979-05-27", "\n", '"scene.toml"', "latin_hypercube", "points = 3"]  # fmt: skip


def changed(text: str, chance: random.Random) -> str:
    lines = text.split("\n")
    for _ in range(chance.randint(1, 3)):
        k = chance.randrange(len(lines))
        words = lines[k].split(" ")
        what = chance.randrange(7)
        if what == 0:
            del lines[k]
            lines = lines or [""]
        elif what == 1:
            lines.insert(k, chance.choice(lines))
        elif what == 2:
            lines.insert(k, chance.choice(WORDS))
        else:
            words[chance.randrange(len(words))] = chance.choice(WORDS)
            lines[k] = " ".join(words)
    return "\n".join(lines)


def test_damaged_studies_and_scenes_are_read_or_refused(tmp_path: Path) -> None:
    chance = random.Random(1)
    study, scene = tmp_path / "study.toml", tmp_path / "scene.toml"
    (tmp_path / "law.toml").write_text(LAW)
    study.write_text(STUDY)
    scene.write_text(SCENE)
    assert len(read_design(study, "1").jobs) == 8  # the unchanged texts are valid
    for case in range(1500):
        of_scene = case % 3 == 0
        study.write_text(STUDY if of_scene else changed(STUDY, chance), errors="surrogateescape")
        scene.write_text(changed(SCENE, chance) if of_scene else SCENE, errors="surrogateescape")
        begin = time.process_time()
        try:
            read_design(study, "1")
        except StudyError as error:
            assert str(error), f"case {case}"
        except Exception as error:
            text = (scene if of_scene else study).read_text(errors="replace")
            raise AssertionError(f"case {case}: {text[:1000]!r}") from error
        # Even a slow processor needs far less than 60 s, so a longer time means an endless loop.
        assert time.process_time() - begin < 60, f"case {case}"


def test_more_points_than_anyone_computes_are_refused_before_they_are_made(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(SCENE)
    axes = "".join(f"a{k} = {list(range(100))}\n" for k in range(9))
    for text, limit in (
        (f"[grid]\n{axes}", "at most"),
        ("[[latin_hypercube]]\npoints = 1000000000000\nspecimen.seed = [1, 2]\n", "from 1 to 1,000,000"),
    ):
        (tmp_path / "study.toml").write_text('scene = "scene.toml"\n' + text)
        try:
            read_design(tmp_path / "study.toml", "1")
        except StudyError as error:
            assert limit in str(error)
        else:
            raise AssertionError("it was read")
