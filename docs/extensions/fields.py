"""The directive ``fields``: the fields of a dataclass as a table, for pages on file formats."""

import dataclasses
import inspect
from importlib import import_module
from typing import Any

from docutils import nodes
from markdown_text import attribute_docs, table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class Fields(SphinxDirective):
    """A row for each field of ``MODULE:CLASS``: name, type, default and meaning."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        module, _, name = self.arguments[0].partition(":")
        owner = getattr(import_module(module), name)
        fields = dataclasses.fields(owner)
        docs = attribute_docs(owner)
        undocumented = [each.name for each in fields if each.name not in docs]
        if undocumented:
            raise self.severe(f"fields of {name} without a docstring: {', '.join(undocumented)}")
        has_default = any(_default(each) for each in fields)
        head = ("Field", "Type", *(["Default"] if has_default else []), "Meaning")
        rows = [
            (
                f"`{each.name}`",
                f"`{inspect.formatannotation(each.type)}`",
                *([_default(each)] if has_default else []),
                docs[each.name],
            )
            for each in fields
        ]
        return self.parse_text_to_nodes(table(head, rows))


def _default(field: "dataclasses.Field[Any]") -> str:
    return "" if field.default is dataclasses.MISSING else f"`{field.default!r}`"


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("fields", Fields)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
