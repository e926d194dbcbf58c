# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of contents follows from the lists of docs/index.md: a part a heading, a page a list item that begins with a link.

So that page reads the same on a Git host, and is the only place where the order is written. A page of docs/ that no list has
joins the last part, "Reference"; pages elsewhere (examples, benchmarks) that no list has are reached by links alone.
"""
import posixpath
import re

INDEX = "docs/index"
ITEM = re.compile(r"^[-*] +\[([^\]]+)\]\(([^)#]+)\)", re.M)
REST = "Reference"


def parts(text):
    """(heading, [(title, document)]) of each heading with a list of pages."""
    found = []
    for heading, body in re.findall(r"^## +(.+?)\n(.*?)(?=^## |\Z)", text, re.M | re.S):
        pages = []
        for title, link in ITEM.findall(body):
            document = posixpath.normpath(posixpath.join("docs", link)).removesuffix(".md")
            pages.append((title.replace("`", ""), {"include/macadam/macadam.hpp": "api/cpp",
                                                   "python/macadam": "api/python"}.get(document, document)))
        if pages:
            found.append((heading, pages))
    return found


def add_parts_of_page(app, docname, source):
    """A page such as docs/scene has the pages of the folder docs/scene/ below it, unless docs/index.md lists them."""
    index = app.env.doc2path(INDEX)
    with open(index, encoding="utf-8") as file:
        listed = {document for _, pages in parts(file.read()) for _, document in pages}
    below = sorted(name for name in app.env.found_docs if posixpath.dirname(name) == docname and name not in listed)
    if below:
        source[0] += "\n\n```{toctree}\n:hidden:\n\n" + "\n".join(f"/{name}" for name in below) + "\n```\n"


def add(app, docname, source):
    if docname != INDEX:
        add_parts_of_page(app, docname, source)
        return
    found = parts(source[0])
    listed = {document for _, pages in found for _, document in pages}
    rest = sorted(name for name in app.env.found_docs
                  if re.fullmatch(r"docs/[\w-]+", name) and name not in listed | {INDEX})
    for heading, pages in found:
        lines = [f"{title} <{'/' + document}>" for title, document in pages]
        lines += [f"/{name}" for name in rest if heading == REST]
        source[0] += "\n\n```{toctree}\n:hidden:\n:caption: " + heading + "\n\n" + "\n".join(lines) + "\n```\n"


def reached_by_links(app, docname, source):
    """Marks pages outside all tables of contents as orphans, so that Sphinx does not warn about them."""
    if not docname.startswith(("docs/", "api/")):
        source[0] = "---\norphan: true\n---\n" + source[0]


def setup(app):
    app.connect("source-read", add)
    app.connect("source-read", reached_by_links)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
