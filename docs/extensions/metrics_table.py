"""The directive ``metrics``: the metrics of a task, by default ``level``, a row each."""

from typing import Any

from colift.benchmark.suites.catalogue import make_task
from colift.benchmark.tasks.level.task import LEVEL
from docutils import nodes
from markdown_text import table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class MetricsTable(SphinxDirective):
    """Name, unit, better direction, treatment of a missing value, and meaning of each metric."""

    optional_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        (name,) = self.arguments or (LEVEL.name,)
        head = ("name", "unit", "better", "without a value", "meaning")
        rows = [
            (
                f"`{each.name}`",
                each.unit,
                each.better,
                "" if each.missing == "never" else each.missing,
                each.meaning,
            )
            for each in make_task(name).metrics.values()
        ]
        return self.parse_text_to_nodes(table(head, rows))


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("metrics", MetricsTable)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
