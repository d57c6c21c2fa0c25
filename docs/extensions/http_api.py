"""The directive ``http_api``: a board's HTTP interface, from its OpenAPI document, and pages."""

import functools
import logging
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from colift.leaderboard.pages.table import PAGES
from colift.leaderboard.service.app import create_app
from colift.leaderboard.views.api import Part, operations, schemas
from docutils import nodes
from markdown_text import table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class HttpApi(SphinxDirective):
    """``operations``: a section each; ``schemas``: one for each object; ``pages``: a table."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the sections."""
        parts = {
            "operations": lambda: map(_operation, operations(_document())),
            "schemas": lambda: map(_schema, schemas(_document())),
            "pages": lambda: [_pages()],
        }
        text = "\n\n".join(parts[self.arguments[0]]())
        return self.parse_text_to_nodes(text, allow_section_headings=True)


@functools.cache
def _document() -> dict[str, Any]:
    """Return the OpenAPI document of a new board."""
    logging.getLogger("alembic").setLevel(logging.WARNING)
    with tempfile.TemporaryDirectory(prefix="colift-docs-") as folder:
        app = create_app(Path(folder, "board"))
        app.state.service.board.close()
        return app.openapi()


def _operation(operation: Part) -> str:
    """Return the section of an operation."""
    return "\n\n".join(_parts(operation))


def _parts(operation: Part) -> Iterator[str]:
    yield f"### `{operation['method']} {operation['path']}`"
    yield operation["description"]
    if operation["needs_token"]:
        yield "Needs the header `Authorization: Bearer TOKEN`."
    if operation["body"]:
        yield f"Body: {operation['body']}"
    if operation["parameters"]:
        yield table(
            ("Parameter", "In", "Type", "Meaning"),
            [
                (f"`{each['name']}`", each["place"], each["kind"], each["meaning"])
                for each in operation["parameters"]
            ],
        )
    answers = operation["responses"]
    yield table(
        ("Response", "Meaning", "Content"),
        [(each["status"], each["meaning"], ", ".join(each["kinds"])) for each in answers],
    )


def _schema(schema: Part) -> str:
    """Return the section of an object in bodies and responses."""
    rows = [(f"`{each['name']}`", each["kind"], each["meaning"]) for each in schema["properties"]]
    return (
        f"### {schema['name']}\n\n{schema['meaning']}\n\n{table(('Key', 'Type', 'Meaning'), rows)}"
    )


def _pages() -> str:
    """Return the table of the pages of a service, with their files in a site."""
    rows = [
        (f"`{page.url}`", f"`{page.file}`" if page.file else "", page.meaning)
        for page in PAGES.values()
        if page.served
    ]
    return table(("Address", "File of a site", "Content"), rows)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("http-api", HttpApi)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
