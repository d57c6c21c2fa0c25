"""What a request to the API asks for: its parts, and answers that many routes share."""

from typing import Annotated, Any, Final

from fastapi import Path, Query, Request

from .errors import Problem

PREFIX: Final = "/api/v1"

SeasonName = Annotated[
    str, Path(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,39}$", description="Name of a season.")
]
Digest = Annotated[
    str, Path(pattern="^[0-9a-f]{64}$", description="Digest of a submission's content.")
]
JobId = Annotated[str, Path(pattern="^[0-9a-f]{32}$", description="A job.")]
SeasonAsked = Annotated[
    str | None,
    Query(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,39}$",
        description="Name of a season; by default the one that takes submissions.",
    ),
]
Word = Query(pattern=r"^[A-Za-z0-9_-]{1,40}$")

BINARY: Final = {"type": "string", "format": "binary"}

MISSING: Final[dict[int | str, dict[str, Any]]] = {
    404: {"model": Problem, "description": "It is not there."}
}

UNKNOWN: Final[dict[int | str, dict[str, Any]]] = {
    401: {"model": Problem, "description": "There is no token, or it does not count."}
}


def api_root(request: Request) -> str:
    """Return where the API is, as the client sees it: a proxy may have put it below a path."""
    return f"{request.scope.get('root_path', '').rstrip('/')}{PREFIX}"
