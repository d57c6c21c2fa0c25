"""Tables of what is registered: policies, behaviours, suites; of people; and of drawn conditions.

``registered GROUP`` has a row for each name in its content, or for each policy of the task
``:task:``; ``people`` one for each range of drawn people; ``conditions SUITE`` one for each
condition that is drawn in the suite.
"""

from dataclasses import fields
from typing import Any, ClassVar

from colift.base.registry import SUITES, lookup, own_entries, policies_by_task, suite_names, summary
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.suites import ranges
from colift.benchmark.suites.suite import make_suite
from docutils import nodes
from docutils.parsers.rst import directives
from markdown_text import attribute_docs, from_docstring, table
from sphinx.application import Sphinx
from sphinx.pycode import ModuleAnalyzer
from sphinx.util.docutils import SphinxDirective


class Registered(SphinxDirective):
    """What is registered in a group: names, and the first lines of their docstrings."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar[dict[str, Any]] = {"task": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        group = self.arguments[0]
        task = self.options.get("task")
        names = policies_by_task()[task] if task else " ".join(self.content).split()
        rows = [(f"`{each}`", from_docstring(summary(lookup(group, each)))) for each in names]
        return self.parse_text_to_nodes(table(("Name", "Meaning"), rows))


class Suites(SphinxDirective):
    """The suites of colift itself, the leading ones first."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        own = own_entries(SUITES)
        rows = [
            (f"`{each}`", summary(lookup(SUITES, each))) for each in suite_names() if each in own
        ]
        return self.parse_text_to_nodes(table(("Suite", "Lifts"), rows))


class People(SphinxDirective):
    """The ranges of drawn people, and the purpose of each."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        docs = ModuleAnalyzer.for_module(ranges.__name__).find_attr_docs()
        rows = []
        for (_, name), lines in docs.items():
            found = getattr(ranges, name)
            numbers = f"{found[0]} to {found[-1]}" if isinstance(found, range) else f"from {found}"
            rows.append((numbers, from_docstring(" ".join(lines).strip())))
        return self.parse_text_to_nodes(table(("Numbers", "People"), rows))


class DrawnConditions(SphinxDirective):
    """The conditions of a suite's lifts, with their ranges."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        conditions = make_suite(self.arguments[0]).scenarios[0].conditions
        docs = attribute_docs(Conditions)
        rows = []
        for field in fields(Conditions):
            low, high = getattr(conditions, field.name)
            if low < high:
                rows.append((f"`{field.name}`", f"{low:g} to {high:g}", docs[field.name]))
        return self.parse_text_to_nodes(table(("Condition", "Range", "Meaning"), rows))


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("conditions", DrawnConditions)
    app.add_directive("people", People)
    app.add_directive("registered", Registered)
    app.add_directive("suites", Suites)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
