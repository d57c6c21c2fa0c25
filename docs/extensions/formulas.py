"""Equations as pictures within the page: no script, no font and no program from elsewhere.

A formula with an unknown command fails the build.
"""

from typing import Any, Final
from xml.etree import ElementTree

import ziamath
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging

SIZE: Final = 1000.0
"""Size at which formulas are drawn; on the page they have that of the text around them.

The library makes tall brackets too tall at sizes below that of the font's own units, 1000."""

SCALE: Final = 1.1
"""Size of a formula relative to the text: this font is smaller than those of browsers."""

logger = logging.getLogger(__name__)
ziamath.config.svg2 = False  # Shared symbols of several formulas on a page would have equal names.


def drawn(node: nodes.Element, *, inline: bool) -> str:
    """Return the formula of a node as SVG, in the size and colour of the text around it."""
    text = node.astext()
    try:
        formula = ziamath.Latex(text, size=SIZE, color="currentColor", inline=inline, margin=0)
    except Exception as error:  # The converter has no common class of errors.
        logger.warning("no formula: %r: %s", error, text, location=node)
        return ""
    if "\\" in formula.mathmlstr():
        logger.warning("an unknown command in a formula: %s", text, location=node)
    picture = formula.svgxml()
    for side in ("width", "height"):
        picture.set(side, f"{float(picture.get(side, '0')) * SCALE / SIZE:.3f}em")
    if inline:
        picture.set("style", f"vertical-align: {formula.getyofst() * SCALE / SIZE:.3f}em")
    picture.set("role", "img")
    picture.set("aria-label", text)
    return ElementTree.tostring(picture, encoding="unicode")


def visit_inline(translator: Any, node: nodes.math) -> None:
    """Write a formula within a line."""
    translator.body.append(f'<span class="formula">{drawn(node, inline=True)}</span>')
    raise nodes.SkipNode


def visit_block(translator: Any, node: nodes.math_block) -> None:
    """Write a formula on a line of its own."""
    translator.body.append(f'<div class="formula">{drawn(node, inline=False)}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer."""
    app.add_html_math_renderer("formulas", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
