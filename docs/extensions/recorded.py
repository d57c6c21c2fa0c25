"""The role ``figure``: a number that stands in the recorded output of a command.

``{figure}`bounds|0.360``` shows 0.360, and fails the build if ``figures/bounds.txt`` has no 0.360.
"""

from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxRole


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


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the role."""
    app.add_role("figure", Figure())
    return {"parallel_read_safe": True, "parallel_write_safe": True}
