# SPDX-License-Identifier: GPL-3.0-or-later
"""The MCP server: its functions, the folder that they keep to, and the tools as a client sees them."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
from pathlib import Path

import pytest

from macadam.mcp.__main__ import main
from macadam.mcp.paths import FILE_KEYS, RequestError, inside
from macadam.mcp.workspace import Workspace
from report_folders import ENVIRONMENT, PROGRAM, run, scene

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with one small scene, beside a secret file."""
    monkeypatch.setenv("MACADAM_PROGRAM", PROGRAM)
    (tmp_path / "secret.csv").write_text("id,x,y,z,radius,phase,body\nsecret")
    work = tmp_path / "work"
    work.mkdir()
    (work / "small.toml").write_text(scene("harmonic"))
    return work


@pytest.fixture
def workspace(folder: Path) -> Workspace:
    return Workspace(folder, threads=1)


def names(answer: dict) -> list[str]:
    return [event["event"] for event in answer["events"]]


def test_info_is_that_of_the_program(workspace: Workspace) -> None:
    said = subprocess.run([PROGRAM, "info", "--json"], capture_output=True, text=True, check=True).stdout
    assert workspace.info() == {"code": 0, "events": [json.loads(said)]}


def test_a_new_scene_is_written_checked_and_never_replaced(workspace: Workspace, folder: Path) -> None:
    made = workspace.new_scene("mixes/../mix.toml", test="monotonic", cracks=True)
    assert made == {"scene": "mix.toml", "text": (folder / "mix.toml").read_text()} and 'kind = "monotonic"' in made["text"]
    checked = workspace.check("mix.toml")
    assert checked["code"] == 0 and names(checked) == ["forecast"] and checked["events"][0]["kind"] == "monotonic"
    with pytest.raises(RequestError, match="mix.toml"):
        workspace.new_scene("mix.toml")
    with pytest.raises(RequestError, match="nonsense"):
        workspace.new_scene("other.toml", test="nonsense")
    assert not (folder / "other.toml").exists()


def test_overrides_reach_the_program(workspace: Workspace) -> None:
    plain, other = (workspace.check("small.toml", o)["events"][0] for o in (None, {"loading.frequencies": [1, 2.5, 5, 10, 20]}))
    assert (plain["solutions"], other["solutions"]) == (3, 5)
    wrong = workspace.check("small.toml", {"loading.cycels": 3})
    assert wrong["code"] == 2 and wrong["events"][0]["key"] == "[loading] cycels"
    text = workspace.check("small.toml", {"specimen.mastic.porosity": 'a "b"'})  # quotes are passed on as text
    assert text["code"] == 2 and names(text) == ["error"]
    for key in ("", "a=b", "a b", "--x y"):
        with pytest.raises(RequestError, match="overrides: found the key"):
            workspace.check("small.toml", {key: 1})
    with pytest.raises(RequestError, match="overrides: loading.cycles: a scene cannot hold a NoneType"):
        workspace.check("small.toml", {"loading.cycles": None})


def test_a_run_its_results_and_its_report(workspace: Workspace, folder: Path) -> None:
    answer = workspace.run("small.toml", "out/first", {"loading.frequencies": [10]})
    assert answer["code"] == 0 and "progress" not in names(answer) and names(answer)[-1] == "end"
    result = next(e for e in answer["events"] if e["event"] == "result")
    found = workspace.results("out/first")
    assert found["folder"] == "out/first" and found["summary"]["results"] == result["results"]
    assert found["files"]["summary.json"] == (folder / "out/first/summary.json").stat().st_size
    run("run", folder / "small.toml", "--out", folder / "by_hand", "--set", "loading.frequencies=[10]")
    by_hand = json.loads((folder / "by_hand/summary.json").read_text())["results"][0]
    assert by_hand["e_star_pa"] == found["summary"]["results"][0]["e_star_pa"]
    assert workspace.report("out/first", "pages/first.html") == {"report": "pages/first.html"}
    assert "<h2>The specimen</h2>" in (folder / "pages/first.html").read_text(encoding="utf-8")
    with pytest.raises(RequestError, match="found no file summary.json"):
        workspace.results("out")
    with pytest.raises(RequestError, match="not a results folder"):
        workspace.report("out")


def test_a_failed_run_is_an_answer(workspace: Workspace, folder: Path) -> None:
    answer = workspace.run("small.toml", "out", {"loading.kind": "nonsense"})
    assert answer["code"] == 2 and names(answer) == ["error", "end"] and not (folder / "out").exists()
    assert workspace.check("missing.toml")["events"][0]["found"] == "no such file"


@pytest.mark.parametrize("path", ["../secret.csv", "/etc/passwd", "a/../../secret.csv", "link", "link/x", "", "a\0b"])
def test_no_path_leaves_the_folder(path: str, workspace: Workspace, folder: Path) -> None:
    (folder / "link").symlink_to(folder.parent)
    calls = (workspace.new_scene, workspace.check, workspace.results, workspace.report, lambda p: workspace.run("small.toml", p),
             lambda p: workspace.run(p, "out"), lambda p: workspace.report("out", p))  # fmt: skip
    before = sorted(folder.parent.rglob("*"))
    for call in calls:
        with pytest.raises(RequestError, match="outside of the folder|null"):
            call(path)
    assert sorted(folder.parent.rglob("*")) == before


OUTSIDE = {
    "specimen.file": "../secret.csv",
    "specimen": {"file": "/etc/passwd"},
    "specimen.shapes.library": "../..",
    "materials.mastic.from": "../secret.csv",
    "specimen.shapes": [{"library": "/etc"}],
}


@pytest.mark.parametrize("key", OUTSIDE)
def test_no_override_names_a_file_outside(key: str, workspace: Workspace) -> None:
    with pytest.raises(RequestError, match="outside of the folder"):
        workspace.check("small.toml", {key: OUTSIDE[key]})


def test_no_scene_names_a_file_outside(workspace: Workspace, folder: Path) -> None:
    (folder / "far.toml").write_text('[loading]\nkind = "history"\nfile = "../secret.csv"\n')
    (folder / "near.toml").write_text('[materials.mastic]\nfrom = "far.toml"\n')
    (folder / "round.toml").write_text('[materials.mastic]\nfrom = "round.toml"\n')
    for name in ("far.toml", "near.toml"):
        with pytest.raises(RequestError, match="'../secret.csv': found a path outside of the folder"):
            workspace.run(name, "out")
    assert workspace.check("round.toml")["code"] == 2  # the program's own message, not an endless search
    (folder / "broken.toml").write_text("[loading\n")
    with pytest.raises(RequestError, match="broken.toml: "):
        workspace.check("broken.toml")


def test_every_key_that_names_a_file_is_known() -> None:
    keys = json.loads(subprocess.run([PROGRAM, "info", "--keys", "json"], capture_output=True, text=True, check=True).stdout)
    named = {k["key"] for k in keys if k["type"] == "text" and ("file" in k["text"].lower() or "folder" in k["text"].lower())}
    assert named == set(FILE_KEYS)


def test_a_path_inside_is_absolute(tmp_path: Path) -> None:
    root = tmp_path.resolve()
    assert inside(root, "a/./b/../c") == root / "a/c" and inside(root, str(root / "d")) == root / "d"
    assert inside(root, "../x", root / "y") == root / "x"


def test_wrong_starts_are_refused(folder: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["--folder", str(folder / "none")]) == 2 and "found no such folder" in capsys.readouterr().err
    assert main(["--folder", str(folder), "--threads", "-1"]) == 2 and "threads: found -1" in capsys.readouterr().err


def test_without_the_package_the_message_names_it(folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture) -> None:
    for name in [n for n in sys.modules if n == "macadam.mcp.server" or n.split(".")[0] == "mcp"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "mcp", None)
    assert main(["--folder", str(folder)]) == 2
    assert "found no Python package mcp 2 or later, expected it" in capsys.readouterr().err


def test_a_client_sees_the_tools(folder: Path) -> None:
    """Starts the command, as an assistant does, and speaks to it over its standard input and output."""
    pytest.importorskip("mcp.server.mcpserver", reason="no package mcp: pip install 'macadam[mcp]'")
    from mcp import Client, StdioServerParameters, stdio_client

    from macadam.mcp.server import TOOLS

    async def talk() -> None:
        command = StdioServerParameters(
            command=sys.executable, args=["-m", "macadam", "mcp", "--folder", str(folder)],
            env={**ENVIRONMENT, "MACADAM_PROGRAM": str(PROGRAM)},
        )  # fmt: skip
        async with Client(stdio_client(command)) as client:
            tools = {tool.name: tool for tool in (await client.list_tools()).tools}
            assert set(tools) == set(TOOLS) and all(tool.description for tool in tools.values())
            assert set(tools["run"].input_schema["properties"]) == {"scene", "out", "overrides"}
            checked = await client.call_tool("check", {"scene": "small.toml", "overrides": {"specimen.seed": 2}})
            assert not checked.is_error and json.loads(checked.content[0].text)["events"][0]["event"] == "forecast"
            refused = await client.call_tool("results", {"folder": "../x"})
            assert refused.is_error and "outside of the folder" in refused.content[0].text

    asyncio.run(talk())
