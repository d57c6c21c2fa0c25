"""The documentation that a board links to: a site elsewhere, or a folder that the board serves."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

from colift.base.errors import InputError
from fastapi.staticfiles import StaticFiles
from starlette.responses import Response
from starlette.types import Scope

PLACE: Final = "/docs"
"""Path of a folder's pages, below the board's root."""

SCHEMES: Final = ("http://", "https://")

POLICY: Final = (
    "default-src 'self'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; base-uri 'none'; frame-ancestors 'none'; object-src 'none'"
)
"""Content security policy of the pages: their theme has scripts and styles inline."""


@dataclass(frozen=True, kw_only=True)
class Documentation:
    """The place of the documentation."""

    address: str
    """Absolute address; empty if the board serves the folder."""
    folder: Path | None = None
    """Folder with the pages, if the board serves them."""

    @classmethod
    def at(cls, place: str) -> Self:
        """Return the documentation at an address, or in a folder.

        Raises
        ------
        InputError
            If it is neither an http or https address nor a folder with an ``index.html``.
        """
        if place.startswith(SCHEMES):
            return cls(address=place)
        folder = Path(place)
        if not (folder / "index.html").is_file():
            raise InputError(
                f"documentation must be an address ({' or '.join(SCHEMES)}...) or a folder with an "
                f"index.html, as docs/build makes it in site; got {place!r}"
            )
        return cls(address="", folder=folder.resolve())

    def link(self, root: str) -> str:
        """Return the address for the pages of a board below ``root``."""
        return self.address or f"{root}{PLACE}/"


class Pages(StaticFiles):
    """The pages of a folder, with a content security policy of their own."""

    def file_response(
        self,
        full_path: "str | os.PathLike[str]",
        stat_result: os.stat_result,
        scope: Scope,
        status_code: int = 200,
    ) -> Response:
        """Return a file of the folder."""
        response = super().file_response(full_path, stat_result, scope, status_code)
        response.headers["Content-Security-Policy"] = POLICY
        return response
