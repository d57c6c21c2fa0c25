"""Types as the code writes them: ``NDArray[np.float64]`` in place of what the alias stands for."""

import re
from itertools import accumulate
from typing import Any, Final

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx

SPELT_OUT: Final = re.compile(r"ndarray\[tuple\[Any, \.\.\.\], dtype\[(\w+)\]\]")
"""What the alias becomes when a type is evaluated."""


def shorten(app: Sphinx, doctree: nodes.document) -> None:
    """Replace the types of arrays in all signatures of a page."""
    for signature in doctree.findall(addnodes.desc_signature):
        for part in list(signature.findall(nodes.Element)):
            _shorten_children(part)


def _shorten_children(part: nodes.Element) -> None:
    """Replace the runs of whole children that spell the type of an array out."""
    begin = 0
    while True:
        texts = [child.astext() for child in part.children]
        starts = [0, *accumulate(map(len, texts))]
        found = SPELT_OUT.search("".join(texts), begin)
        if found is None:
            return
        begin = found.end()
        if {found.start(), found.end()} <= set(starts):
            first, last = starts.index(found.start()), starts.index(found.end())
            part[first:last] = [addnodes.desc_sig_name("", f"NDArray[np.{found[1]}]")]
            begin = 0


def readable(
    app: Sphinx, kind: str, name: str, owner: Any, options: Any, signature: str, returned: str
) -> tuple[str, str] | None:
    """Give a default that a factory makes as ``...``: Sphinx cannot read ``<factory>``."""
    if signature and "<factory>" in signature:
        return signature.replace("<factory>", "..."), returned
    return None


def setup(app: Sphinx) -> dict[str, Any]:
    """Change signatures before they are parsed, and pages after."""
    app.connect("autodoc-process-signature", readable)
    app.connect("doctree-read", shorten)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
