# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that scripts/documents --check fails for copies of the documents with one fault each.

usage: documents_check_test.py REPOSITORY; exit code 1 if a fault passes, or if a correct document does not."""
import contextlib
import io
import re
import runpy
import shutil
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
from pages import accuracy, accuracy_asked, accuracy_rows, common, data  # noqa: E402


PROGRAM = runpy.run_path(str(ROOT / "scripts" / "documents"))


def documents(folder, *options):
    """Runs scripts/documents in this process, so that the results are read only once."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        code = PROGRAM["main"](["--root", str(folder), *options])
    return code, said.getvalue()


def other_digit(text):
    """Returns the text with its first digit changed."""
    return re.sub(r"\d", lambda m: str((int(m[0]) + 1) % 10), text, count=1)


def in_table(text):
    return re.sub(r"(<!-- table [\w.]+ -->.*?)(\d)", lambda m: m[1] + other_digit(m[2]), text, count=1, flags=re.S)


def in_sentence(text):
    return re.sub(r"(<!--= [^>]* -->[^<\d]*)(\d)", lambda m: m[1] + other_digit(m[2]), text, count=1)


def unmarked_twin(text):
    """Returns the text with the last of several uses of one mark replaced by its number without the mark."""
    uses = list(re.finditer(r"<!--= steady_error -->(.*?)<!--/-->", text))
    assert len(uses) > 1
    return text[:uses[-1].start()] + uses[-1][1] + text[uses[-1].end():]


# document, change to it, and the message that is expected in addition to file and line
FAULTS = [
    ("docs/frequency-solver.md", in_table, "expected"),
    ("docs/choose-settings.md", in_sentence, "expected"),
    ("docs/verification.md", in_sentence, "expected"),
    ("README.md", in_sentence, "expected"),
    ("docs/paper-specimens.md", lambda t: t + "more\n", "expected"),
    ("bench/results/accuracy-tables.md", other_digit, "expected"),
    ("docs/skips.md", lambda t: t.replace("<!-- table ", "<!-- table un", 1), "no such function"),
    ("docs/skips.md", lambda t: t.replace("<!-- end -->", "", 1), "has no '<!-- end -->'"),
    ("docs/filling.md", lambda t: re.sub(r"<!--= \w+", "<!--= nothing", t, count=1), "no such function"),
    ("bench/README.md", lambda t: t.replace("<!--/-->", "", 1), "a broken mark"),
    ("docs/filling.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | 1.5 % |\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | −2e-3 |\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\na | b\n--|--\nc | **5** of 6\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n> - | a | b |\n>   |:-:|---:|\n>   | c | about 3 × 4 µs |\n",
     "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | `x` [7 GPa](x.md) |\n", "stands in no mark"),
    ("more.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | 1 |\n", "stands in no mark"),
    ("docs/scene.md", lambda t: t + "\n<!-- by hand: two words -->\n", "a broken mark"),
    ("docs/shapes.md", lambda t: t + "\nIt is <!--= machine -->1<!--/--> s.\n", "no module of this document"),
    ("docs/shapes.md", lambda t: t + "\n<!-- table saved -->\n\n<!-- end -->\n", "no module of this document"),
    ("docs/skips.md", lambda t: t + "\n<!-- not shown: <!--= twice -->0 %<!--/--> -->\n", "within an HTML comment"),
    ("docs/skips.md", lambda t: t + "\n<!--\n<!--= machine -->x<!--/-->\n-->\n", "within an HTML comment"),
    ("docs/voids.md", lambda t: t + "\nThe angle is low, and this is no chance.\n", "a claim without a number"),
    ("examples/demo/README.md", in_table, "expected"),
    ("docs/skips.md", lambda t: t + "\nIt is 3.5e-7 of it.\n", "'3.5e-7' stands in no mark"),
    ("docs/choose-settings.md", lambda t: t + "\n- It takes 12 s.\n", "'12 s' stands in no mark"),
    ("README.md", lambda t: t + "\nIt is 2 % more.\n", "'2 %' stands in no mark"),
    ("README.md", lambda t: t.replace("for an error of 1e-3", "for an error", 1), "which is not there"),
    ("docs/choose-settings.md", unmarked_twin, "is typed by hand"),
    ("docs/skips.md", lambda t: t.replace(". The table shows", ".\n<!--= twice -->0 %<!--/-->", 1),
     "begins the line"),
    ("docs/model.md", lambda t: t.replace("(model/motion.md)", "(model/movement.md)", 1), "which is not there"),
    ("docs/model/motion.md", lambda t: t + "\nSee [the code](../../host/nowhere.cpp).\n", "which is not there"),
    ("docs/shapes.md", lambda t: t.replace("#your-own-shapes", "#none") + "\n[here](#not-a-heading)\n",
     "without this heading"),
    ("docs/scene/shapes.md", lambda t: t.replace("(../shapes.md#your-own-shapes)", "(../shapes.md#my-shapes)", 1),
     "without this heading"),
]


def of_results():
    """Tests what the pages state about a committed row that failed, and about a file that does not exist."""
    def refused(call, text):
        try:
            said = call()
        except LookupError as error:
            return [] if text in str(error) else [f"'{text}' was expected: {error}"]
        return [f"nothing was refused for '{text}', but said: {said}"]

    row = {"study": "front", "scene": "t8", "mix": "AM1", "frequency_hz": 20.0, "density_scaling": 1.0,
           "gap_max": None, "status": "diverged"}
    every = accuracy_rows.every
    wrong = refused(lambda: data.rows("none.csv"), "bench/results/none.csv is not there")
    accuracy_rows.every = lambda: [*every(), row]
    wrong += refused(lambda: accuracy_rows.study("front"), "front of t8, 20 Hz, scaling 1: diverged")
    accuracy_rows.every = lambda: [*every(), {**row, "study": "tolerance"}]
    if not re.fullmatch(r"in (\d+) of \d+ runs; 1 failed", accuracy_asked.tolerance_kept()):
        wrong.append(f"a failed run with a tolerance: {accuracy_asked.tolerance_kept()}")
    accuracy_rows.every = lambda: [*every(), {**row, "study": "step_share", "start": "steady", "step_share": 1.4}]
    if "t8 at 1.37 (not at 1.40)" not in accuracy.stable_share():
        wrong.append(f"a step that diverges: {accuracy.stable_share()}")
    accuracy_rows.every = lambda: [*every(), {**row, "study": "tolerance", "scene": "new", "tolerance": 1e-2}]
    if not any(line.startswith("| new | 1e-2 | none: all failed |") for line in accuracy_asked.tolerance()):
        wrong.append("a scene whose runs with a tolerance all failed is not in their table")
    accuracy_rows.every = lambda: [{**r, "status": "falls apart: 3 pieces"} if r["gap_max"] == 0 and r["scene"] == "t8"
                                   else r for r in every()]
    if "falls apart, (t8)" not in accuracy.gap_zero():
        wrong.append(f"a network that falls apart: {accuracy.gap_zero()}")
    accuracy_rows.every = every
    return wrong


def of_tests():
    """Tests that a number asserted in a test is found only under its own name."""
    where = ("t8_test", "TwentyHertzInBothForms")
    if common.asserted(*where, "difference", "1e-10") != "1e-10":
        return ["an asserted number is not found"]
    try:
        common.asserted(*where, "amplitude_of_nothing", "1e-10")
    except LookupError:
        return []
    return ["a number is found that is asserted of another name"]


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("pictures"))
        (folder / "bench" / "results").mkdir(parents=True)
        for file in ("README.md", "bench/README.md", "bench/history.md", "bench/results/accuracy-tables.md"):
            shutil.copy(ROOT / file, folder / file)
        for file in (ROOT / "examples").glob("*/README.md"):
            (folder / "examples" / file.parent.name).mkdir(parents=True)
            shutil.copy(file, folder / "examples" / file.parent.name)
        (folder / "more.md").write_text("# More\n", encoding="utf-8")
        documents(folder)  # so that this test does not depend on documents_test
        code, said = documents(folder, "--check")
        if code != 0:
            wrong.append(f"sound documents fail:\n{said}")
        for file, spoil, expected in FAULTS:
            sound = (folder / file).read_text(encoding="utf-8")
            spoilt = spoil(sound)
            if spoilt == sound:
                wrong.append(f"{file}: nothing was spoilt for '{expected}'")
            (folder / file).write_text(spoilt, encoding="utf-8")
            code, said = documents(folder, "--check")
            if code != 1 or not re.search(rf"^{re.escape(file)}:\d+: .*{re.escape(expected)}", said, re.M):
                wrong.append(f"{file}, '{expected}': exit code {code} and\n{said}")
            (folder / file).write_text(sound, encoding="utf-8")
    wrong += of_results() + of_tests()
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
