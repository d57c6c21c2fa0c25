"""Tables from the code.

``fields`` are those of a dataclass, ``entries`` those of a mapping, and ``members`` the methods and
properties of a class.
"""

import dataclasses
import inspect
import json
from importlib import import_module
from typing import Any, Final

from docutils import nodes
from markdown_text import attribute_docs, attribute_types, from_docstring, table
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


class Entries(SphinxDirective):
    """A row for each entry of ``MODULE:MAPPING``, whose values are texts."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        module, _, name = self.arguments[0].partition(":")
        entries = getattr(import_module(module), name)
        rows = [(f"`{each}`", meaning) for each, meaning in entries.items()]
        return self.parse_text_to_nodes(table(("Name", "Meaning"), rows))


class Members(SphinxDirective):
    """A row for each public method and property of ``MODULE:CLASS``, and of those above it."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        module, _, name = self.arguments[0].partition(":")
        owner = getattr(import_module(module), name)
        found = {
            each: from_docstring(inspect.getdoc(member).partition("\n\n")[0])
            for base in owner.__mro__[:-1]
            for each, member in vars(base).items()
            if not each.startswith("_") and inspect.getdoc(member)
        }
        rows = [(f"`{each}`", meaning) for each, meaning in found.items()]
        return self.parse_text_to_nodes(table(("Member", "Meaning"), rows))


def _default(field: "dataclasses.Field[Any]") -> str:
    """Return the default as JSON and TOML write it; that of another class by its name."""
    if field.default is dataclasses.MISSING:
        return ""
    if dataclasses.is_dataclass(field.default):
        return f"`{type(field.default).__name__}()`"
    return f"`{json.dumps(field.default)}`"


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("entries", Entries)
    app.add_directive("fields", Fields)
    app.add_directive("members", Members)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
