# SPDX-License-Identifier: GPL-3.0-or-later
"""Links of pages to other files of the repository: each such file and folder becomes a page of the site, under source/.

A public header is linked to its page of the reference instead, and a folder with a README.md to that.
"""
import html
import posixpath
import subprocess
from pathlib import Path

from docutils import nodes
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.util import ClassNotFound
from sphinx import addnodes

ROOT = Path(__file__).resolve().parents[2]
LARGEST = 300_000  # bytes that are shown of a file


def page_of(path, found_docs):
    """The page of a path of the repository: one that is there, or one of those made below."""
    if path in (".", ""):
        return "README"
    for name in (path.removesuffix(".md"), f"{path}/README", path.replace("include/macadam", "api/cpp", 1).removesuffix(".hpp")):
        if name in found_docs:
            return name
    if path == "include/macadam/macadam.hpp":
        return "api/cpp"
    return f"source/{path}"


def resolve(app, doctree):
    """Resolves the links that Sphinx has left: paths of files in the repository."""
    document = app.env.docname
    wanted = app.env.__dict__.setdefault("repository_files", {})
    wanted[document] = set()
    for node in list(doctree.findall(addnodes.pending_xref)):
        if node.get("reftype") != "myst" or node.get("refdomain") or "#" in node["reftarget"]:
            continue
        path = posixpath.normpath(posixpath.join(posixpath.dirname(document), node["reftarget"]))
        if path.startswith("..") or not (ROOT / path).exists():
            continue  # MyST says that it is not there
        page = page_of(path, app.env.found_docs)
        if page.startswith("source/"):
            wanted[document].add(path)
        link = nodes.reference("", "", *node.children[0].children, internal=True,
                               refuri=app.builder.get_relative_uri(document, page))
        node.replace_self(link)


def listing(path):
    """Names in a folder that git knows, folders once."""
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", path], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.splitlines()
    return sorted({posixpath.join(path, name[len(path) + 1:].split("/")[0]) for name in files})


def body(app, page, path):
    file = ROOT / path
    if file.is_dir():
        items = []
        for name in listing(path):
            target = page_of(name, app.env.found_docs)
            items.append(f'<li><a href="{app.builder.get_relative_uri(page, target)}">{html.escape(posixpath.basename(name))}'
                         f'{"/" if (ROOT / name).is_dir() else ""}</a></li>')
        return f"<ul>{''.join(items)}</ul>"
    data = file.read_bytes()
    if file.suffix == ".png":
        target = Path(app.outdir) / "_images" / f"{path.replace('/', '-')}"
        target.parent.mkdir(exist_ok=True)
        target.write_bytes(data)
        return f'<img src="{"../" * page.count("/")}_images/{target.name}" alt="{html.escape(path)}">'
    try:
        text = data[:LARGEST].decode("utf-8", errors="strict" if len(data) <= LARGEST else "ignore")
    except UnicodeDecodeError:
        return f"<p>{len(data)} bytes, no text.</p>"
    try:
        lexer = get_lexer_for_filename(file.name)
    except ClassNotFound:
        lexer = TextLexer()
    more = f"<p>The first {LARGEST} of {len(data)} bytes.</p>" if len(data) > LARGEST else ""
    return more + highlight(text, lexer, HtmlFormatter(cssclass="highlight"))


def pages(app):
    """Returns the pages of linked files and of the files in linked folders."""
    paths = sorted(set().union(*app.env.__dict__.get("repository_files", {}).values(), set()))
    done = set()
    while paths:
        path = paths.pop()
        if path in done:
            continue
        done.add(path)
        if (ROOT / path).is_dir():
            paths += [name for name in listing(path) if page_of(name, app.env.found_docs).startswith("source/")]
        page = f"source/{path}"
        title = html.escape(path)
        yield page, {"title": path, "body": f"<h1>{title}</h1>\n" + body(app, page, path)}, "page.html"


def purge(app, env, docname):
    env.__dict__.get("repository_files", {}).pop(docname, None)


def merge(app, env, docnames, other):
    """Merges the links that another process found in its part of the pages."""
    mine, found = env.__dict__.setdefault("repository_files", {}), other.__dict__.get("repository_files", {})
    mine.update({name: found[name] for name in docnames if name in found})


def setup(app):
    app.connect("env-merge-info", merge)
    app.connect("doctree-read", resolve)
    app.connect("env-purge-doc", purge)
    app.connect("html-collect-pages", pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
