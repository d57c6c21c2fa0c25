"""The directive ``rooms``: its content lists folders, and :mod:`room_picture` draws them."""

from typing import Any

from docutils import nodes
from room_picture import drawn, read_rooms
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class Rooms(SphinxDirective):
    """The picture of the folders that the content lists."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return the picture."""
        try:
            rooms = read_rooms(list(self.content))
        except ValueError as error:
            raise self.severe(str(error)) from error
        return [nodes.raw("", drawn(rooms), format="html")]


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("rooms", Rooms)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
