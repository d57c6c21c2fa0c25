"""The directive ``json-schema``: the keys that a JSON Schema requires, as a table."""

from collections.abc import Iterator
from importlib import import_module
from typing import Any

from docutils import nodes
from markdown_text import table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class JsonSchema(SphinxDirective):
    """A row for each key of the schema that ``MODULE:FUNCTION`` returns, with its path."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        module, _, name = self.arguments[0].partition(":")
        schema = getattr(import_module(module), name)()
        return self.parse_text_to_nodes(table(("Key", "Type", "Meaning"), _rows(schema)))


def _rows(schema: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield path, type and meaning of each key; those of a mean that stands for many, once."""
    for name, each in schema.get("properties", {}).items():
        path = f"{prefix}{name}"
        yield f"`{path}`", _kind(each), each.get("description", "")
        if each.get("properties", {}).keys() != {"mean", "missing"}:
            yield from _rows(each, f"{path}.")
        if isinstance(each.get("items"), dict):
            yield from _rows(each["items"], f"{path}[].")
        if isinstance(each.get("additionalProperties"), dict):
            yield from _rows(each["additionalProperties"], f"{path}.NAME.")


def _kind(schema: dict[str, Any]) -> str:
    """Return the type of a value in a few words."""
    if "anyOf" in schema:
        return " or ".join(map(_kind, schema["anyOf"]))
    if "prefixItems" in schema:
        return f"{len(schema['prefixItems'])} numbers"
    kind = schema["type"]
    return kind if isinstance(kind, str) else " or ".join(kind)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("json-schema", JsonSchema)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
