# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the pages of the reference before Sphinx reads: a page a public header, in the order in which data flows, and one of
the Python package."""
import inspect
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEADERS = ROOT / "include"

CPP = """# C++

The public headers, in the order in which data flows. `#include <macadam/macadam.hpp>` has them all, and
[examples/tutorial](../examples/tutorial/README.md) begins with them.

| header | what |
|---|---|
{rows}

```{{toctree}}
:hidden:

{pages}
```
"""

PYTHON = """# Python

The package, a name at a time. [docs/python.md](../docs/python.md) shows how they go together.

"""

PARTS = [("Scenes and specimens", ("_scene", "_specimen")), ("Tests and their results", ("_simulation",)),
         ("Laws and calibration", ("_fit", "_calibration")), ("The compiled core", ("_core",))]
MODULES = ("shapes", "drives", "ct", "mixture", "report", "study")


def headers(name="macadam/macadam.hpp", seen=None):
    """Those that macadam.hpp includes, directly or by other headers, each once; a header of headers after them."""
    seen = {} if seen is None else seen
    for other in re.findall(r'^#include "(macadam/[\w/]+\.hpp)"', (HEADERS / name).read_text(encoding="utf-8"), re.M):
        if other not in seen:
            seen[other] = None
            if other.endswith("/all.hpp"):
                headers(other, seen)
    return list(seen)


def brief(header):
    """Returns the first sentence of the description of a header."""
    text = (HEADERS / header).read_text(encoding="utf-8")
    said = re.search(r"\\file \S+ +((?:.*\n)(?:///.+\n)*)", text)
    words = " ".join(re.sub(r"^///", "", line).strip() for line in said[1].splitlines())
    return re.split(r"(?<=[.:])\s", words)[0].rstrip(":.").replace("|", "\\|").replace("*", "\\*")


def cpp(folder):
    known = {file.relative_to(HEADERS).as_posix() for file in HEADERS.rglob("*.hpp")} - {"macadam/macadam.hpp"}
    order = headers()
    order += sorted(known - set(order))
    rows, pages = [], []
    for header in order:
        page = header.removeprefix("macadam/").removesuffix(".hpp")
        file = folder / "cpp" / f"{page}.md"
        file.parent.mkdir(parents=True, exist_ok=True)
        write(file, f"# {header.removeprefix('macadam/')}\n\n`#include <{header}>`\n\n```{{eval-rst}}\n.. doxygenfile:: {header}\n"
                    "   :sections: briefdescription detaileddescription innernamespace innerclass define func typedef enum var "
                    "public-func public-attrib public-static-func public-static-attrib public-type friend\n```\n")
        rows.append(f"| [{page}](cpp/{page}.md) | {brief(header)} |")
        pages.append(f"{page} <cpp/{page}>")
    write(folder / "cpp.md", CPP.format(rows="\n".join(rows), pages="\n".join(pages)))


def directive(module, name, value):
    if inspect.isclass(value):
        kind = "autoexception" if issubclass(value, BaseException) else "autoclass"
    else:
        kind = "autofunction" if callable(value) else "autodata"
    return f"```{{eval-rst}}\n.. {kind}:: {module}.{name}\n```\n\n"


def python(folder):
    import macadam
    elsewhere = {name for module in MODULES for name in getattr(macadam, module).__all__}  # shown there
    text = PYTHON
    for title, homes in PARTS:
        text += f"## {title}\n\n"
        for name in (name for home in homes for name in macadam._HOMES[home] if not name.startswith("_") and name not in elsewhere):
            text += f"### {name}\n\n" + directive("macadam", name, getattr(macadam, name))
    for module in MODULES:
        text += f"## macadam.{module}\n\n```{{eval-rst}}\n.. automodule:: macadam.{module}\n   :imported-members:\n```\n\n"
    write(folder / "python.md", text)


def paths(folder):
    """Breathe looks for files by the names in Doxygen's index, which have no folder; those of headers of one name differ by it."""
    index = (folder / "index.xml").read_text(encoding="utf-8")

    def whole(found):
        compound = (folder / f"{found[1]}.xml").read_text(encoding="utf-8")
        file = re.findall(r'<location file="([^"]+)"/>', compound)[-1]
        return f'<compound refid="{found[1]}" kind="file"><name>{file}</name>'

    (folder / "index.xml").write_text(
        re.sub(r'<compound refid="(\w+)" kind="file"><name>[^<]*</name>', whole, index), encoding="utf-8")


def write(file, text):
    """Writes the file only if its text differs, so that Sphinx reads only changed files again."""
    if not file.is_file() or file.read_text(encoding="utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def make(app):
    folder = Path(app.srcdir) / "api"
    paths(Path(app.config.breathe_projects["macadam"]))
    cpp(folder)
    python(folder)


def setup(app):
    app.connect("builder-inited", make)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
