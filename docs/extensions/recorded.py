"""Recorded outputs of commands: numbers from them, and sentences that fit the page.

``{figure}`references|0.360``` shows 0.360, and fails the build if
``figures/references.txt`` has no 0.360.
"""

from pathlib import Path
from typing import Any, Final

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxRole

WIDTH: Final = 88
"""Characters of a line on a page."""

FOLDS: Final = "folds"
"""Class of an output whose long lines are sentences, which fold at the edge of the page."""


class Figure(SphinxRole):
    """A number of a recorded output."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Return the number, if the output has it."""
        name, _, text = self.text.partition("|")
        path = Path(self.env.srcdir) / "figures" / f"{name}.txt"
        self.env.note_dependency(path)
        if not path.is_file() or text not in path.read_text(encoding="utf-8"):
            problem = self.inliner.reporter.error(
                f"figures/{name}.txt has no {text!r}", line=self.lineno
            )
            return [self.inliner.problematic(self.rawtext, self.rawtext, problem)], [problem]
        return [nodes.Text(text)], []


def mark(app: Sphinx, doctree: nodes.document) -> None:
    """Mark the recorded outputs whose tables fit the page: lines of a table are indented."""
    for block in doctree.findall(nodes.literal_block):
        lines = block.astext().splitlines()
        if "source" in block and all(len(line) <= WIDTH for line in lines if line[:1] == " "):
            block["classes"].append(FOLDS)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the role, and mark the outputs of a page that has been read."""
    app.add_role("figure", Figure())
    app.connect("doctree-read", mark)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
