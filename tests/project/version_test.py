# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests scripts/version in a repository, in a source archive, and without both: version_test.py SOURCE_FOLDER"""
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

SOURCE = Path(sys.argv[1])
NAMELESS = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull, "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@b",
            "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@b", "GIT_COMMITTER_DATE": "1700000000 +0000"}


def ran(folder, *words):
    return subprocess.run(words, cwd=folder, env={**os.environ, **NAMELESS}, check=True, capture_output=True, text=True).stdout.strip()


def expect(folder, expected, *options):
    found = ran(folder, "scripts/version", *options)
    assert found == expected, f"{folder} {options}: found {found}, expected {expected}"


def not_filled_in(file):
    """Returns the text of the file as in a repository. In a source archive git has replaced the placeholders by values."""
    questions = {"commit": "%H", "epoch": "%ct", "describe": "%(describe:tags=true,abbrev=10,match=v[0-9]*.[0-9]*.[0-9]*)"}
    text = "".join(f"{name}: $Format:{question}$\n" for name, question in questions.items())
    assert "$Format" not in file.read_text() or file.read_text() == text, f"{file} asks for something else"
    return text


def unpacked(repository, folder):
    ran(repository, "git", "archive", "-o", folder.parent / "archive.tar", "HEAD")
    with tarfile.open(folder.parent / "archive.tar") as archive:
        archive.extractall(folder, filter="data") if hasattr(tarfile, "data_filter") else archive.extractall(folder)
    return folder


with tempfile.TemporaryDirectory() as temporary:
    work = Path(temporary)
    plain = work / "plain"
    (plain / "scripts").mkdir(parents=True)
    shutil.copy(SOURCE / "scripts/version", plain / "scripts")
    shutil.copy(SOURCE / ".gitattributes", plain)
    (plain / ".git_archival.txt").write_text(not_filled_in(SOURCE / ".git_archival.txt"))
    (plain / "CHANGELOG.md").write_text("# Changelog\n\n## [Unreleased]\n\n## [0.4.2] - 2026-01-02\n\n## [0.4.1] - 2025-01-02\n")
    expect(plain, "0.4.2")  # only the changelog is available, as in a source that pip unpacks
    expect(plain, "unknown", "--commit")
    expect(plain, "0", "--epoch")

    repository = work / "repository"
    shutil.copytree(plain, repository)
    ran(repository, "git", "init", "-q")
    ran(repository, "git", "add", ".")
    ran(repository, "git", "commit", "-qm", "first")
    commit = ran(repository, "git", "rev-parse", "--short=10", "HEAD")
    expect(repository, f"0.4.2+g{commit}")  # a clone without tags
    expect(repository, "0.4.2", "--number")
    expect(repository, "1700000000", "--epoch")
    shutil.copytree(plain, repository / "within")  # a source that is unpacked in a repository but not part of it
    expect(repository / "within", "0.4.2")
    shutil.rmtree(repository / "within")
    expect(unpacked(repository, work / "untagged"), f"0.4.2+g{commit}")

    ran(repository, "git", "tag", "somewhere")
    ran(repository, "git", "tag", "v0.5.0")
    expect(repository, "0.5.0")
    expect(unpacked(repository, work / "tagged"), "0.5.0")
    ran(repository, "git", "commit", "-qm", "second", "--allow-empty")
    commit = ran(repository, "git", "rev-parse", "--short=10", "HEAD")
    expect(repository, f"0.5.0+1.g{commit}")
    expect(repository, "0.5.0", "--number")
    later = unpacked(repository, work / "later")
    expect(later, f"0.5.0+1.g{commit}")
    expect(later, commit, "--commit")
    expect(later, "1700000000", "--epoch")

    ran(repository, "git", "commit", "-qm", "third", "--allow-empty")
    ran(repository, "git", "tag", "v0.6.0-rc1")  # not a version of the form X.Y.Z
    said = subprocess.run(["scripts/version"], cwd=repository, capture_output=True, text=True, env={**os.environ, **NAMELESS})
    assert said.returncode == 1 and "expected X.Y.Z" in said.stderr, said
print("passed")
