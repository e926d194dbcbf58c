# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: sections with text, tables and pictures, combined into one HTML file that needs no other file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any
from urllib.parse import quote

from macadam.report import look
from macadam.report.export import Export

# The browser may load nothing from elsewhere and run no script. So the page will look the same
# in ten years.
_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


@dataclass
class _Section:
    title: str
    parts: list[str] = field(default_factory=list)


class Page:
    """A page with sections in the order in which they were begun. Empty sections are not written."""

    def __init__(self, several: bool = False, export: Export | None = None) -> None:
        self.several = several  # whether the page has several folders; if so, each block shows the name of its folder
        self.export = export  # writes figures and tables also as files of their own; None: they are only on the page
        self._sections: list[_Section] = []
        self._figures = 0
        self.companions: dict[str, str] = {}  # files that are written beside the page: name, text
        self.left_out: list[tuple[str, str, str]] = []  # entries left out of the page: folder, what, why

    def section(self, title: str) -> None:
        self._sections.append(_Section(title))

    def text(self, words: str, kind: str = "") -> None:
        """Adds a paragraph; `kind` "warning" or "failure" makes it stand out."""
        self._add(f'<p class="{kind}">{escape(words)}</p>' if kind else f"<p>{escape(words)}</p>")

    def link(self, file: str, name: str, words: str) -> None:
        """Adds a paragraph that begins with a link to a file beside the page."""
        self._add(f'<p><a href="{escape(quote(file), quote=True)}">{escape(name)}</a>. {escape(words)}</p>')

    def heading(self, words: str) -> None:
        self._add(f"<h3>{escape(words)}</h3>")

    def figure(self, made: Any, caption: str, alt: str, third: bool = False, raster: bool = False) -> None:
        """Adds a matplotlib figure with a numbered caption. third: a third of the width, so that three consecutive
        figures stand side by side. raster: embed as PNG."""
        if self.export:
            self.export.figure(made, self._figures + 1, caption, alt, raster)
        width, height = made.get_size_inches()
        share = 100 if third else round(100 * width / look.WIDE)
        self._picture(
            look.embed(made, raster),
            caption,
            alt,
            "third" if third else "whole",
            f'style="width:{share}%" width="{96 * width:.0f}" height="{96 * height:.0f}"',
        )

    def picture(self, source: str, caption: str, alt: str) -> None:
        """Adds an existing picture. source: a data URL, which contains the whole picture."""
        self._picture(source, caption, alt, "whole given", "")

    def data(self, name: str, table: Any) -> None:
        """Writes a table of pandas as `name`.csv beside the exported figures; does nothing if figures are not exported."""
        if self.export:
            self.export.table(name, table)

    def preformatted(self, words: str) -> None:
        """Adds text with its own line breaks, such as a scene."""
        self._add(f'<pre class="scroll">{escape(words)}</pre>')

    def _picture(self, source: str, caption: str, alt: str, kind: str, size: str) -> None:
        self._figures += 1
        self._add(
            f'<figure class="{kind}"><img src="{source}" alt="{escape(alt, quote=True)}" {size}>'
            f"<figcaption><b>Figure {self._figures}.</b> {escape(caption)}</figcaption></figure>"
        )

    def table(self, head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "", words: int = 1) -> None:
        """Adds a table. Its first `words` columns hold text; the others hold numbers and are aligned to the right."""

        def cells(row: Sequence[Any], tag: str) -> str:
            return "".join(
                f'<{tag} class="{"t" if k < words else "n"}">{escape(look.number(c))}</{tag}>'
                for k, c in enumerate(row)
            )

        rows = list(rows)
        keep = " keep" if len(rows) < 16 else ""  # a short table is not broken at the end of a page
        keep += " many" if len(head) > 7 else ""  # many columns: smaller text, so that they fit on the page
        body = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows)
        title = f'<p class="title">{escape(caption)}</p>' if caption else ""
        self._add(
            f'<div class="scroll{keep}">{title}<table><thead><tr>{cells(head, "th")}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>"
        )

    def columns(self, blocks: Sequence[tuple[str, str, str]]) -> None:
        """Adds blocks side by side: title, colour, and HTML that is already escaped. A single block gets no title,
        unless the page has several folders."""
        if len(blocks) == 1 and not self.several:
            self._add(f'<div class="block">{blocks[0][2]}</div>')
            return
        inner = "".join(
            f'<div class="block"><h4 style="border-color:{colour}">{escape(title)}</h4>{html}</div>'
            for title, colour, html in blocks
        )
        self._add(f'<div class="columns">{inner}</div>')

    def leave_out(self, folder: str, what: str, why: str) -> None:
        if (folder, what, why) not in self.left_out:
            self.left_out.append((folder, what, why))

    def _add(self, html: str) -> None:
        self._sections[-1].parts.append(html)

    def html(self, title: str, subtitle: str, foot: str) -> str:
        """Returns the text of the HTML file."""
        shown = [s for s in self._sections if s.parts]
        style = (Path(__file__).parent / "style.css").read_text(encoding="utf-8")
        links = " · ".join(f'<a href="#s{k}">{escape(s.title)}</a>' for k, s in enumerate(shown))
        body = "".join(
            f'<section id="s{k}"><h2>{escape(s.title)}</h2>{"".join(s.parts)}</section>' for k, s in enumerate(shown)
        )
        return (
            f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">'
            f'<link rel="icon" href="data:,"><title>{escape(title)}</title><style>{style}</style></head>'
            f'<body><header><p class="mark">Macadam</p><h1>{escape(title)}</h1><p>{escape(subtitle)}</p>'
            f"<nav>{links}</nav></header><main>{body}</main><footer>{escape(foot)}</footer></body></html>\n"
        )


def facts(pairs: Iterable[tuple[str, Any]]) -> str:
    """Returns a list of names and values as HTML."""
    return (
        "<dl>"
        + "".join(f"<dt>{escape(name)}</dt><dd>{escape(look.number(value))}</dd>" for name, value in pairs)
        + "</dl>"
    )


def points(items: Iterable[str]) -> str:
    return "<ul>" + "".join(f"<li>{escape(item)}</li>" for item in items) + "</ul>"
