"""The directive ``fields``: the fields of a dataclass as a table, for pages on file formats."""

import dataclasses
import json
from importlib import import_module
from typing import Any, Final

from docutils import nodes
from markdown_text import attribute_docs, attribute_types, table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

KINDS: Final = {
    "str": "text",
    "int": "integer",
    "float": "number",
    "bool": "boolean",
    "tuple[str, ...]": "list of texts",
    "Mapping[str, str]": "texts by name",
    "Mapping[str, int]": "integers by name",
    "float | None": "number or null",
    "bool | None": "boolean or null",
}
"""Types of Python as those of JSON and TOML; others keep their name."""


class Fields(SphinxDirective):
    """A row for each field of ``MODULE:CLASS``: name, type, default and meaning."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        module, _, name = self.arguments[0].partition(":")
        owner = getattr(import_module(module), name)
        fields = dataclasses.fields(owner)
        docs, types = attribute_docs(owner), attribute_types(owner)
        undocumented = [each.name for each in fields if each.name not in docs]
        if undocumented:
            raise self.severe(f"fields of {name} without a docstring: {', '.join(undocumented)}")
        has_default = any(_default(each) for each in fields)
        head = ("Field", "Type", *(["Default"] if has_default else []), "Meaning")
        rows = [
            (
                f"`{each.name}`",
                KINDS.get(types[each.name], f"`{types[each.name]}`"),
                *([_default(each)] if has_default else []),
                docs[each.name],
            )
            for each in fields
        ]
        return self.parse_text_to_nodes(table(head, rows))


def _default(field: "dataclasses.Field[Any]") -> str:
    """Return the default as JSON and TOML write it."""
    return "" if field.default is dataclasses.MISSING else f"`{json.dumps(field.default)}`"


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("fields", Fields)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
