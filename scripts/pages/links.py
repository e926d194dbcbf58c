# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the links of documents to files of the repository and to headings in them."""
import functools
import posixpath
import re

from pages.marks import VALUE

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"`[^`]*`")
ELSEWHERE = re.compile(r"[a-z]+:")  # https:, mailto:


def anchor(heading):
    """Returns GitHub's anchor of a heading: lower case without punctuation, blanks as hyphens."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", VALUE.sub(r"\2", heading)).replace("\\", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


@functools.lru_cache(maxsize=None)
def anchors(text):
    """Returns the anchors of a page. The second and later of equal headings are numbered."""
    found, fenced = [], False
    for line in text.splitlines():
        fenced ^= line.startswith("```")
        if not fenced and (m := re.match(r"#+ +(.*)", line)):
            name = anchor(m[1])
            same = sum(re.fullmatch(re.escape(name) + r"(-\d+)?", other) is not None for other in found)
            found.append(f"{name}-{same}" if same else name)
    return found


def broken(name, lines, roots):
    """Returns messages for links to files or headings that are in none of the folders."""
    def file(path):
        return next((root / path for root in roots if (root / path).exists()), None)

    wrong, fenced = [], False
    for k, line in enumerate(lines):
        fenced ^= line.startswith("```")
        if fenced or line.startswith("    "):
            continue
        for link in LINK.findall(CODE.sub("`x`", VALUE.sub(r"\2", line))):
            path, _, heading = link.partition("#")
            if ELSEWHERE.match(link):
                continue
            target = file(posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name)
            if target is None:
                wrong.append(f"{name}:{k + 1}: a link to '{link}', which is not there")
            elif heading and heading not in anchors(target.read_text(encoding="utf-8")):
                wrong.append(f"{name}:{k + 1}: a link to '{link}', a page without this heading")
    return wrong
