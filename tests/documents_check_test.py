# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/documents --check can fail: a copy of the documents with one fault each.

usage: documents_check_test.py REPOSITORY; exit code 1 where a fault passes, or where a sound document does not."""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()


def documents(folder, *options):
    run = subprocess.run([sys.executable, ROOT / "scripts" / "documents", "--root", folder, *options],
                         capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


def other_digit(text):
    """The text with its first digit changed."""
    return re.sub(r"\d", lambda m: str((int(m[0]) + 1) % 10), text, count=1)


def in_table(text):
    return re.sub(r"(<!-- table \w+ -->.*?)(\d)", lambda m: m[1] + other_digit(m[2]), text, count=1, flags=re.S)


def in_sentence(text):
    return re.sub(r"(<!--= [^>]* -->[^<\d]*)(\d)", lambda m: m[1] + other_digit(m[2]), text, count=1)


# what is done to which document, and what must be said of it beside file and line
FAULTS = [
    ("docs/accuracy.md", in_table, "expected"),
    ("docs/accuracy.md", in_sentence, "expected"),
    ("README.md", in_sentence, "expected"),
    ("docs/stability.md", lambda t: t.replace("| pass |", "| passed |", 1), "expected"),
    ("docs/paper-specimens.md", lambda t: t + "more\n", "expected"),
    ("bench/results/accuracy-tables.md", other_digit, "expected"),
    ("docs/skips.md", lambda t: t.replace("<!-- table ", "<!-- table un", 1), "no such function"),
    ("docs/skips.md", lambda t: t.replace("<!-- end -->", "", 1), "has no '<!-- end -->'"),
    ("docs/filling.md", lambda t: re.sub(r"<!--= \w+", "<!--= nothing", t, count=1), "no such function"),
    ("bench/README.md", lambda t: t.replace("<!--/-->", "", 1), "a broken mark"),
    ("docs/filling.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | 1.5 % |\n", "stands in no mark"),
    ("docs/scene.md", lambda t: t + "\n| a | b |\n|---|---|\n| c | −2e-3 |\n", "stands in no mark"),
    ("docs/skips.md", lambda t: t.replace(". The table is that of", ".\n<!--= twice -->0 %<!--/-->", 1), "begins the line"),
]


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("pictures"))
        (folder / "bench" / "results").mkdir(parents=True)
        for file in ("README.md", "bench/README.md", "bench/results/accuracy-tables.md"):
            shutil.copy(ROOT / file, folder / file)
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
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
