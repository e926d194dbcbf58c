# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: sections with text, tables and pictures, put together into one HTML file that asks for nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from macadam.report import look

# Nothing may be loaded from anywhere, and no script runs: the file shows the same in ten years.
_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


@dataclass
class _Section:
    title: str
    parts: list[str] = field(default_factory=list)


class Page:
    """Sections in the order in which they are begun. A section without a part is not written."""

    def __init__(self, several: bool = False) -> None:
        self.several = several  # folders: each says its name
        self._sections: list[_Section] = []
        self._figures = 0
        self.left_out: list[tuple[str, str, str]] = []  # folder, what, why

    def section(self, title: str) -> None:
        self._sections.append(_Section(title))

    def text(self, words: str, kind: str = "") -> None:
        """A paragraph; `kind` "warning" or "failure" makes it stand out."""
        self._add(f'<p class="{kind}">{escape(words)}</p>' if kind else f"<p>{escape(words)}</p>")

    def heading(self, words: str) -> None:
        self._add(f"<h3>{escape(words)}</h3>")

    def figure(self, made: Any, caption: str, alt: str, third: bool = False, raster: bool = False) -> None:
        """A matplotlib figure with a numbered caption; three thirds that follow one another stand side by side."""
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
        """A picture that is there already, as an address that holds it whole."""
        self._picture(source, caption, alt, "whole given", "")

    def _picture(self, source: str, caption: str, alt: str, kind: str, size: str) -> None:
        self._figures += 1
        self._add(
            f'<figure class="{kind}"><img src="{source}" alt="{escape(alt, quote=True)}" {size}>'
            f"<figcaption><b>Figure {self._figures}.</b> {escape(caption)}</figcaption></figure>"
        )

    def table(self, head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "", words: int = 1) -> None:
        """A table; its first `words` columns hold text, the others numbers, which stand to the right."""

        def cells(row: Sequence[Any], tag: str) -> str:
            return "".join(
                f'<{tag} class="{"t" if k < words else "n"}">{escape(look.number(c))}</{tag}>'
                for k, c in enumerate(row)
            )

        rows = list(rows)
        keep = " keep" if len(rows) < 16 else ""  # a short one is not parted by the end of a page
        keep += " many" if len(head) > 7 else ""  # columns: smaller, so that the page holds them
        body = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows)
        title = f'<p class="title">{escape(caption)}</p>' if caption else ""
        self._add(
            f'<div class="scroll{keep}">{title}<table><thead><tr>{cells(head, "th")}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>"
        )

    def columns(self, blocks: Sequence[tuple[str, str, str]]) -> None:
        """Blocks beside one another: title, colour, and HTML that is safe already. One alone needs no title."""
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
        """The whole file."""
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
    """A list of names and values as HTML."""
    return (
        "<dl>"
        + "".join(f"<dt>{escape(name)}</dt><dd>{escape(look.number(value))}</dd>" for name, value in pairs)
        + "</dl>"
    )


def points(items: Iterable[str]) -> str:
    return "<ul>" + "".join(f"<li>{escape(item)}</li>" for item in items) + "</ul>"
