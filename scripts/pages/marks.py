# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds marks in Markdown, which are the places that scripts/documents writes, and fills them. A mark holds a query of
the committed results (results.py, functions.py): `<!--= QUERY -->text<!--/-->` in a sentence, without the word SELECT,
and

<!-- table
QUERY
-->

the table

<!-- end -->

`turned` in place of `table` makes columns of the rows, `lines` makes preformatted text of one column, and `copy` writes
its rows as they are, such as the lines of another page's table."""
import re
from dataclasses import dataclass, field

from pages.functions import Refused

BLOCK = re.compile(r"^( *)<!-- (table|turned|lines|copy)$")
CLOSE = re.compile(r"^ *-->$")
END = re.compile(r"^ *<!-- end -->$")
VALUE = re.compile(r"<!--= (.+?) -->(.*?)<!--/-->")
# Comment before a table whose numbers are not marked: by hand with a reason of three words or more, or the command that
# printed the table.
BY_HAND = re.compile(r"^ *<!-- (by hand: \S+( \S+){2,}|made by macadam( \S+)+; do not edit) -->$")
ANY = re.compile(r"<!--(=|/| *(table|turned|lines|copy|end|by hand)\b)")
WITHIN = re.compile(r"<!--(?:(?!-->).)*?<!--", re.S)


@dataclass
class Page:
    """A document with its marks filled. outside: lines of the document, in which the lines of blocks are empty.
    written: the query of each text that a mark wrote."""
    name: str
    text: str = ""
    outside: list = field(default_factory=list)
    written: dict = field(default_factory=dict)
    wrong: list = field(default_factory=list)

    def say(self, number, message):
        self.wrong.append(f"{self.name}:{number}: {message}")


def compared(name, first, found, expected):
    """Returns messages for the lines that differ from the expected ones. first: number of the first line."""
    wrong = []
    for k in range(max(len(found), len(expected))):
        here, there = (lines[k] if k < len(lines) else "no line" for lines in (found, expected))
        if here != there:
            wrong.append(f"{name}:{first + k}: found '{here}', expected '{there}'")
    if len(wrong) > 20:
        wrong[20:] = [f"{name}: and {len(wrong) - 20} more lines"]
    return wrong


def asked(page, number, ask, query):
    """Returns the answer to a query, or None and a message."""
    try:
        return ask(query)
    except Refused as error:  # reported once, even if several marks need a missing file
        if "is not there" not in str(error) or not any(str(error) in line for line in page.wrong):
            page.say(number, f"{error}, in the mark '{' '.join(query.split())}'")
        return None


def block(page, results, lines, k, check):
    """Fills the block that begins at line k. Returns the new lines of the block and the number of its old lines; None
    if the end of the block is missing."""
    indent, kind = BLOCK.match(lines[k]).groups()
    close = next((j for j in range(k + 1, len(lines)) if CLOSE.match(lines[j])), len(lines))
    end = next((j for j in range(close + 1, len(lines)) if END.match(lines[j]) or BLOCK.match(lines[j])), len(lines))
    if end == len(lines) or not END.match(lines[end]):
        page.say(k + 1, f"'{lines[k].strip()}' has no '<!-- end -->'")
        return None
    body = asked(page, k + 1, getattr(results, kind), "\n".join(line.strip() for line in lines[k + 1:close]))
    found = lines[close + 1:end]
    expected = found if body is None else ["", *((indent + line).rstrip() for line in body), ""]
    if check:
        page.wrong += compared(page.name, close + 2, found, expected)
    return lines[k:close + 1] + expected + [lines[end]], end - k + 1


def sentence(page, results, number, line, check):
    """Fills the values in a line."""
    def value(m):
        # if a line begins with a comment, Markdown takes the whole line for HTML
        if not re.sub(r"^(\s|[-*>]\s|\d+\.\s)*", "", line[:m.start()]):
            page.say(number, "a mark begins the line, which Markdown then takes for HTML")
        if "|" in m[1].replace("\\|", "") and line.lstrip().startswith("|"):
            page.say(number, f"a mark with a bar in a table: '{m[1]}'")
        if not results.reads_results(m[1]):
            page.say(number, f"a mark that reads no results: '{m[1]}'")
        new = asked(page, number, results.value, m[1])
        if new is None:
            return m[0]
        page.written[new] = m[1]
        if check and new != m[2]:
            page.say(number, f"mark '{m[1]}': found '{m[2]}', expected '{new}'")
        return f"<!--= {m[1]} -->{new}<!--/-->"

    filled = VALUE.sub(value, line)
    if ANY.search(VALUE.sub("", line)) and not BY_HAND.match(line):
        page.say(number, f"a broken mark: '{line.strip()}'")
    return filled


def filled(name, text, results, check):
    """Returns the document with its marks filled, with messages about faults and, if `check` is set, differences."""
    page, out, lines, k = Page(name), [], text.splitlines(), 0
    for m in WITHIN.finditer(text):
        page.say(text.count("\n", 0, m.start()) + 1, "a mark within an HTML comment")
    while k < len(lines):
        if BLOCK.match(lines[k]):
            made = block(page, results, lines, k, check)
            if made is None:
                page.text, page.outside = text, lines
                return page
            out += made[0]
            page.outside += [""] * made[1]
            k += made[1]
        else:
            out.append(sentence(page, results, k + 1, lines[k], check))
            page.outside.append(lines[k])
            k += 1
    page.text = "\n".join(out) + "\n"
    return page
