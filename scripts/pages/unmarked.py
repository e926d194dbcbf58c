# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds numbers in documents that are not in a mark: in tables, in sentences, and values that a mark writes at another
place."""
import csv
import re
import subprocess

from pages.marks import BY_HAND, VALUE

# The delimiter row of a Markdown table, also in a quote or a list
DELIMITER = re.compile(r"^[\s>]*([-*+] +|\d+[.)] +)?(?=.*\|)\|?( *:?-+:? *\|)* *:?-*:? *$")
CODE = re.compile(r"`[^`]*`")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
DIGITS = re.compile(r"[+\-−±~≈<>≤≥]*\d[\d.,]*(e[+\-−]?\d+)?[⁻⁰¹²³⁴-⁹]*")
UNITS = set("""a about above and at below by contacts cycle cycles day days each from GB GPa GiB h Hz hour hours in KiB
kg least less many MB MiB m minute minutes mm more most MPa ms ns µs of or over Pa particles per s second seconds
several spheres step steps TB than the times to up within x e""".split())
CLAIM = re.compile(r"\b(?:no chance|by chance alone|negligib\w+|insignificant)\b|\bis (?:low|high)\b(?! enough)")
DEFINES = ("default", "key")  # heads of columns with definitions instead of measured numbers
# documents whose sentences are checked too
STRICT = ("README.md", "bench/README.md", "docs/choose-settings.md", "docs/verification.md",
          "docs/frequency-solver.md", "docs/skips.md")
MEASURED = re.compile(r"(?<![\w.])\d[\d.,]*(?:e[+\-−]?\d+|[  ]?(?:%|°|s\b|ms\b|µs\b|GB\b))")


def documents(root):
    """Returns every Markdown file: those that git tracks or would add; without git, all except those in build
    folders."""
    if (root / ".git").exists():
        try:
            found = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.md"], cwd=root, check=True,
                                   capture_output=True, text=True).stdout.splitlines()
            return sorted(name for name in set(found) if (root / name).is_file())
        except (OSError, subprocess.CalledProcessError):
            pass
    built = re.compile(r"(^|/)\.|^(build|results)")
    return sorted(name for file in root.rglob("*.md") if not built.search(name := file.relative_to(root).as_posix()))


def plain(text):
    """Returns a text without its marks, code and links."""
    return LINK.sub(r"\1", CODE.sub("", VALUE.sub("", text)))


def is_number(cell):
    """Returns whether a cell contains a digit and, apart from numbers, only units."""
    cell = plain(cell)
    if not re.search(r"\d", cell):
        return False
    return all(word in UNITS for word in re.findall(r"[^\W\d_]+", DIGITS.sub(" ", cell)))


def cells(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip(" >").strip().strip("|"))]


def tables(name, lines):
    """Returns messages for tables with numbers outside marks. A table after a comment with a reason (marks.BY_HAND) is ignored."""
    wrong = []
    for k in range(1, len(lines)):
        if not DELIMITER.match(lines[k]) or "|" not in lines[k - 1] + lines[k]:
            continue
        before = next((line for line in reversed(lines[:k - 1]) if line.strip()), "")
        if BY_HAND.match(before):
            continue
        heads = cells(lines[k - 1])
        for line in lines[k + 1:]:
            if not line.strip(" >"):
                break
            found = [c for j, c in enumerate(cells(line))
                     if is_number(c) and (heads[j] if j < len(heads) else "") not in DEFINES]
            if found:
                wrong.append(f"{name}:{k}: a table with numbers, such as '{found[0]}', stands in no mark and has no "
                             "'<!-- by hand: reason -->' before it")
                break
    return wrong


def allowed(file):
    """Reads scripts/pages/by-hand.csv: document, text, and the reason why the text's numbers are not measured here."""
    with open(file, encoding="utf-8") as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def sentences(name, lines, by_hand):
    """Returns messages for numbers in sentences that look measured: a power of ten, or a number with a unit."""
    wrong, entries = [], [e for e in by_hand if e["document"] == name]
    missing = {e["text"] for e in entries}
    for k, line in enumerate(lines):
        if line.startswith("    "):  # code
            continue
        for e in entries:
            if e["text"] in line:
                missing.discard(e["text"])
                line = line.replace(e["text"], "")
        wrong += [f"{name}:{k + 1}: '{m[0]}' stands in no mark, nor is it in scripts/pages/by-hand.csv"
                  for m in MEASURED.finditer(plain(line))]
    return wrong + [f"{name}:1: scripts/pages/by-hand.csv allows '{text}', which is not there" for text in missing]


def claims(name, lines):
    """Returns messages for sentences that judge a size without a number: "φ is low, and this is no chance"."""
    wrong, text = [], "\n".join(lines)
    for paragraph in re.split(r"\n\s*\n", text):
        if paragraph.lstrip().startswith(("|", "    ")):
            continue
        for sentence in re.split(r"(?<=[.;:])\s+", paragraph):
            if (m := CLAIM.search(plain(sentence))) and not re.search(r"\d", VALUE.sub(r"\2", sentence)):
                number = text.count("\n", 0, text.index(sentence)) + 1
                wrong.append(f"{name}:{number}: '{m[0]}' is a claim without a number")
    return wrong


def copied(name, lines, written):
    """Returns messages for values that a mark writes at one place and that another place has without a mark."""
    wrong, lines = [], ["" if line.startswith("    ") else plain(line) for line in lines]
    for value, what in written.items():
        if len(re.findall(r"\d", value)) < 2 or len(value) < 4 or "asserted" in what:
            continue  # too short to be distinguished from other numbers, or a limit that the text may name as well
        place = re.compile(rf"(?<![\w.,·]){re.escape(value)}(?![\w,.]*\d)")
        wrong += [f"{name}:{k + 1}: '{value}' has no mark here; the mark '{what}' writes it elsewhere"
                  for k, line in enumerate(lines) if value in line and place.search(line)]
    return wrong
