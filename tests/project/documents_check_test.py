# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that scripts/documents --check fails for copies of the documents with one fault each.
Also tests the queries of marks (comments in a document that say which value of a table its number is).

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
from pages import functions, results  # noqa: E402

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
    """Returns the text in which the first digit after the query of the first table is changed."""
    return re.sub(r"(<!-- table\n.*?-->.*?)(\d)", lambda m: m[1] + other_digit(m[2]), text, count=1, flags=re.S)


def in_sentence(text):
    return re.sub(r"(<!--= .+? -->[^<\d]*)(\d)", lambda m: m[1] + other_digit(m[2]), text, count=1)


def queried(query):
    """Returns a function that replaces the query of the first mark in a sentence by `query`."""
    return lambda text: re.sub(r"<!--= .+? -->", lambda m: f"<!--= {query} -->", text, count=1)


# document, change to it, and the message that is expected in addition to file and line
FAULTS = [
    ("bench/README.md", in_table, "expected"),
    ("bench/README.md", in_sentence, "expected"),
    ("docs/filling.md", in_sentence, "expected"),
    ("docs/paper-specimens.md", lambda t: t + "more\n", "expected"),
    ("examples/demo/README.md", in_table, "expected"),
    ("docs/skips.md", lambda t: re.sub(r'FROM "skips.csv"\)', 'FROM "no-skips.csv")', t), "no-skips.csv is not there"),
    ("docs/skips.md", lambda t: t.replace("<!-- end -->", "", 1), "has no '<!-- end -->'"),
    ("docs/filling.md", queried('colour FROM "fill-study.csv"'), "no such column: colour"),
    ("docs/filling.md", queried('spheres FROM "fill-study.csv"'), "where one value is expected"),
    ("docs/filling.md", queried('max(spheres) FROM "fill-study.csv" WHERE spheres < 0'), "no value"),
    ("docs/filling.md", queried('one(spheres) FROM "fill-study.csv"'), "rows where one is expected"),
    ("docs/filling.md", queried('fail(\'not so\') FROM "fill-study.csv"'), "not so"),
    ("docs/filling.md", queried("text('{:.1f} %', 12)"), "a mark that reads no results"),
    ("bench/README.md", lambda t: t.replace("<!--/-->", "", 1), "a broken mark"),
    ("docs/filling.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | 1.5 % |\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | −2e-3 |\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\na | b\n--|--\nc | **5** of 6\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n> - | a | b |\n>   |:-:|---:|\n>   | c | about 3 × 4 µs |\n",
     "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | `x` [7 GPa](x.md) |\n", "stands in no mark"),
    ("docs/shapes.md", lambda t: t + "\n| a <!--= '1' || '2' -->12<!--/--> | b |\n", "a mark with a bar in a table"),
    ("more.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | 1 |\n", "stands in no mark"),
    ("docs/scene.md", lambda t: t + "\n<!-- by hand: two words -->\n", "a broken mark"),
    ("docs/skips.md", lambda t: t + "\n<!-- not shown: <!--= 'x' -->x<!--/--> -->\n", "within an HTML comment"),
    ("docs/skips.md", lambda t: t + "\n<!--\n<!--= 'x' -->x<!--/-->\n-->\n", "within an HTML comment"),
    ("docs/voids.md", lambda t: t + "\nThe angle is low, and this is no chance.\n", "a claim without a number"),
    ("docs/skips.md", lambda t: t + "\nIt is 3.5e-7 of it.\n", "'3.5e-7' stands in no mark"),
    ("bench/README.md", lambda t: t + "\n- It takes 12 s.\n", "'12 s' stands in no mark"),
    ("README.md", lambda t: t + "\nIt is 2 % more.\n", "'2 %' stands in no mark"),
    ("bench/README.md", lambda t: t + "\nThere are 35,760 of them.\n", "has no mark here"),
    ("docs/skips.md", lambda t: t + "\n<!--= 'x' -->x<!--/--> is it.\n", "begins the line"),
    ("docs/model.md", lambda t: t + "\nSee [it](model/movement.md).\n", "which is not there"),
    ("docs/model/motion.md", lambda t: t + "\nSee [the code](../../host/nowhere.cpp).\n", "which is not there"),
    ("docs/shapes.md", lambda t: t + "\n[here](#not-a-heading)\n", "without this heading"),
    ("docs/scene.md", lambda t: t + "\n[here](shapes.md#my-shapes)\n", "without this heading"),
]


def with_entry(program, folder):
    """Returns a message if scripts/documents accepts an entry of by-hand.csv whose text is on no page."""
    module = program["unmarked"]
    entry = {"document": "README.md", "text": "a text that is on no page", "reason": "a test"}
    wrong = module.sentences("README.md", (folder / "README.md").read_text(encoding="utf-8").splitlines(), [entry])
    return [] if any("which is not there" in line for line in wrong) else ["an entry for a text that is not there passes"]


def answered(base, query):
    """Returns the value that the query of a mark gives, or the reason for which it is refused."""
    try:
        return base.value(query)
    except functions.Refused as error:
        return f"refused: {error}"


def of_queries():
    """Tests the functions of queries with tables of their own."""
    base = results.Results()
    base.add("numbers.csv", ("name", "x", "other"), [("a", 1.0, -2e-7), ("b", 3.0, 0.0052), ("a", 2.0, None)])
    base.add("words.txt", ("n", "line", "heading"), [(0.0, "12 particles, 7 contacts", None)])
    wrong = []
    for query, expected in (
            ('count(*) FROM "numbers.csv"', "3"),
            ('text(\'{:.1f} of {:,.0f}\', -max(x), 12345) FROM "numbers.csv"', "−3.0 of 12,345"),
            ('listed(name) FROM "numbers.csv"', "a and b"),
            ('joined(name, -x) FROM "numbers.csv"', "b, a"),
            ('span(x, text(\'{:.0f}\', x)) FROM "numbers.csv"', "1 to 3"),
            ('span(x, text(\'{:.0f}\', x)) FROM "numbers.csv" WHERE x = 2', "2"),
            ('median(x) FROM "numbers.csv"', "2"),
            ('one(x) FROM "numbers.csv" WHERE name = \'b\'', "3"),
            ('one(x) FROM "numbers.csv" WHERE name = \'a\'', "refused: 2 rows where one is expected"),
            ('errors(other, x) FROM "numbers.csv" WHERE other IS NOT NULL', "0.0052 and 3°"),
            ('one(other) FROM "numbers.csv" WHERE name = \'c\'', "refused: no value"),
            ('one(x / other) FROM "numbers.csv" WHERE x = 1', "-5000000"),
            ('part(line, \'(\\d+) contacts\') FROM "words.txt"', "7"),
            ('part(line, \'(\\d+) walls\') FROM "words.txt"', "refused: no value"),
            ('count(*) FROM "mutation.csv" WHERE typeof(line) <> \'real\'', "0"),
            ('count(*) FROM "many.csv" WHERE typeof("commit") <> \'text\'', "0"),
            ("power(upto(0.00012345))", "1.3e-4"), ("signed(-0.5)", "−5e-1"), ("bound(-0.0123)", "0.013"),
            ("plain(0.0456)", "0.046"), ("downto(0.0456, 1)", "0.04"),
            ('x FROM "none.csv"', "refused: bench/results/none.csv is not there: bench/README.md says which command makes it")):
        if (found := answered(base, query)) != expected:
            wrong.append(f"{query}: found '{found}', expected '{expected}'")
    table = base.table('SELECT name, x AS "x (s):" FROM "numbers.csv" WHERE x > 1')
    if table != ["| name | x (s) |", "|---|---:|", "| b | 3 |", "| a | 2 |"]:
        wrong.append(f"a table: {table}")
    copy = base.copy('SELECT line FROM "docs/keys.md" WHERE heading = \'`[loading]`\' AND line GLOB \'|*\'')
    if not copy[1].startswith("|---") or not any("`kind`" in line for line in copy):
        wrong.append(f"lines of another page: {copy}")
    turned = base.turned('SELECT name AS ":", x FROM "numbers.csv" WHERE x > 1')
    if turned != ["|  | b | a |", "|---|---:|---:|", "| x | 3 | 2 |"]:
        wrong.append(f"a turned table: {turned}")
    return wrong


def of_failed_runs():
    """Tests the message about a committed run that failed."""
    base = results.Results()
    base.ask("SELECT count(*) FROM accuracy_runs")
    heads = [row[1] for row in base.base.execute('PRAGMA table_info("accuracy.csv")')]
    row = {"study": "tolerance", "scene": "new", "mix": "AM1", "frequency_hz": 20.0, "density_scaling": 1.0,
           "tolerance": 1e-2, "status": "diverged"}
    kept = answered(base, "tried - failed FROM accuracy_kept")
    base.add("accuracy.csv", heads, [[row.get(head) for head in heads]])
    wrong = []
    if answered(base, "failed FROM accuracy_kept") != "1" or answered(base, "tried - failed FROM accuracy_kept") != kept:
        wrong.append("a failed run with a tolerance is not counted")
    row |= {"study": "step_share", "scene": "t8", "start": "steady", "step_share": 1.4}
    base.add("accuracy.csv", heads, [[row.get(head) for head in heads]])
    if answered(base, "failed FROM accuracy_steps WHERE name = 't8'") != "1.4":
        wrong.append("a step that diverges is not the first that failed")
    row |= {"study": "front"}
    base.add("accuracy.csv", heads, [[row.get(head) for head in heads]])
    if (found := answered(base, "count(*) FROM accuracy_runs")) != "refused: front of t8, 20 Hz, scaling 1: diverged":
        wrong.append(f"a run that must not fail: {found}")
    return wrong


def of_tests():
    """Tests that a number asserted in a test is found only under its own name."""
    where = ("t8_test", "TwentyHertzInBothForms")
    if functions.asserted(*where, "difference", "1e-10") != "1e-10":
        return ["an asserted number is not found"]
    try:
        functions.asserted(*where, "amplitude_of_nothing", "1e-10")
    except LookupError:
        return []
    return ["a number is found that is asserted of another name"]


def copied(folder):
    """Copies the documents into a folder."""
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("pictures"))
    for file in [*ROOT.glob("*.md"), *(ROOT / "bench").rglob("*.md"), *(ROOT / "examples").glob("*/README.md")]:
        (folder / file.relative_to(ROOT)).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, folder / file.relative_to(ROOT))
    (folder / "more.md").write_text("# More\n", encoding="utf-8")


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        copied(folder)
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
        wrong += with_entry(PROGRAM, folder)
    wrong += of_queries() + of_failed_runs() + of_tests()
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
