# SPDX-License-Identifier: GPL-3.0-or-later
"""Equations as MathML, which browsers draw themselves: no script, no network. docutils makes it of LaTeX."""
import html
import re

from docutils import nodes
from docutils.utils.math import MathError, latex2mathml
from sphinx.util import logging

TAG = re.compile(r"\\tag\{([^}]*)\}")
ACCENTED = re.compile(r"""<munderover>\s*(<(\w+)[^>]*>(?:(?!<munderover>).)*?</\2>)\s*(<(\w+)[^>]*>(?:(?!<munderover>).)*?</\4>)
                          \s*(<mo[^>]*>[˙ˆ¨˜¯‾→]</mo>)\s*</munderover>""", re.X | re.S)
log = logging.getLogger(__name__)


def made(node, text, block):
    try:
        # the index of an accented symbol stands beside the symbol; docutils puts it below, as for a sum
        return ACCENTED.sub(r"<msub><mover>\1\5</mover>\3</msub>", latex2mathml.tex2mathml(text.strip(), as_block=block))
    except MathError as error:
        log.warning("an equation cannot be made into MathML: %s: %s", error, text.strip(), location=node)
        return html.escape(text)


def inline(writer, node):
    writer.body.append(made(node, node.astext(), False))
    raise nodes.SkipNode


def block(writer, node):
    text = node.astext()
    numbers = ", ".join(TAG.findall(text))
    number = f'<span class="eqno">({html.escape(numbers)})</span>' if numbers else ""
    writer.body.append(f'<div class="equation">{made(node, TAG.sub("", text), True)}{number}</div>\n')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    app.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
