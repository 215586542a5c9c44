"""Formulas as MathML, which browsers typeset: no script, no network, no TeX."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging

LOGGER = logging.getLogger(__name__)
_FUNCTION = re.compile(r"<mi>(sin|cos|tan|max|min|exp)</mi>")
# An operator, not a name: the renderer leaves no space before its argument.
_SPACED = r'<mo lspace="0.17em" rspace="0.17em">\1</mo>'


def setup(app: Any) -> dict[str, bool]:
    """Register the renderer that ``html_math_renderer`` names."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _inline(writer: Any, node: nodes.math) -> None:
    writer.body.append(_set(node))
    raise nodes.SkipNode


def _block(writer: Any, node: nodes.math_block) -> None:
    writer.body.append(f'<div class="math">{_set(node, block=True)}</div>\n')
    raise nodes.SkipNode


def _set(node: nodes.Element, *, block: bool = False) -> str:
    try:
        formula: str = tex2mathml(node.astext(), as_block=block)
    except MathError as error:
        LOGGER.warning("%s: %s", error, node.astext(), location=node)
        return ""
    return _FUNCTION.sub(_SPACED, formula)
