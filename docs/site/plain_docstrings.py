# SPDX-License-Identifier: GPL-3.0-or-later
"""Docstrings of the Python package are plain text with `code` and indented examples, not reStructuredText."""
import re


def plain(app, what, name, obj, options, lines):
    made = []
    for line in lines:
        code = line.startswith("    ")
        if code and made and made[-1] and not made[-1].startswith("    "):
            made.append("")
        if code and not any(made_line.startswith(("    ", "::")) for made_line in made[-2:]):
            made += ["::", ""]
        made.append(line if code else escaped(line))
    lines[:] = made


def escaped(line):
    """Returns the line with `code` as literal text and all other markup characters escaped."""
    parts = re.split(r"(`[^`]+`)", line)
    return "".join(f"`{p}`" if k % 2 else re.sub(r"([*|_\\])", r"\\\1", p) for k, p in enumerate(parts))


def setup(app):
    app.connect("autodoc-process-docstring", plain, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
