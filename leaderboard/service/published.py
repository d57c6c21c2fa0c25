"""What the API publishes: seasons, standings, entries and their bundles."""

import tempfile
from collections.abc import Iterator
from typing import Annotated

from fastapi import APIRouter, Request, Response
from fastapi.responses import StreamingResponse

from ...agents.submissions.folder import CHUNK
from ..archive import pack
from ..standing import Standing
from ..views.lifts import CellScore, cell_scores
from ..views.table import standings_csv
from .answers import EntryAnswer, SeasonAnswer, StandingAnswer
from .asked import BINARY, MISSING, Digest, SeasonAsked, SeasonName, Word, api_root
from .errors import problem
from .state import Service, State
from .uploads import ZIP

router = APIRouter()


@router.get("/seasons")
def seasons(service: Service) -> list[SeasonAnswer]:
    """Return all seasons of the board."""
    return [SeasonAnswer.of(season) for season in service.board.seasons()]


@router.get("/standings", responses=MISSING)
def standings(
    service: Service,
    season: SeasonAsked = None,
    behaviour: Annotated[str | None, Word] = None,
    subject: Annotated[str | None, Word] = None,
) -> list[StandingAnswer]:
    """Return the rows of a season, best first; with the public lifts of a behaviour or subject.

    Rank groups are over all hidden lifts, whatever is asked for.
    """
    rows = _standings(service, season)
    if behaviour is None and subject is None:
        return [StandingAnswer.of(row, None) for row in rows]
    cells = [_cells(service, row) for row in rows]
    _check_word("behaviour", behaviour, {cell.behaviour for some in cells for cell in some})
    _check_word("subject", subject, {cell.subject for some in cells for cell in some})
    chosen = [
        [
            cell
            for cell in some
            if behaviour in (None, cell.behaviour) and subject in (None, cell.subject)
        ]
        for some in cells
    ]
    return [StandingAnswer.of(row, some) for row, some in zip(rows, chosen, strict=True)]


@router.get(
    "/standings.csv",
    response_class=Response,
    responses={**MISSING, 200: {"content": {"text/csv": {"schema": {"type": "string"}}}}},
)
def csv(service: Service, season: SeasonAsked = None) -> Response:
    """Return the rows of a season as a table for spreadsheets and pandas."""
    _check_season(service, season)
    return Response(standings_csv(service.board, season), media_type="text/csv")


@router.get("/entries/{season}/{digest}", responses=MISSING)
def entry(service: Service, request: Request, season: SeasonName, digest: Digest) -> EntryAnswer:
    """Return what the board says of a submission in a season."""
    found = service.board.entry(season, digest)
    if found is None:
        raise problem(404, f"season {season} has no entry {digest}")
    bundle = None
    if service.board.bundle(season, digest) is not None:
        bundle = f"{api_root(request)}/entries/{season}/{digest}/bundle.zip"
    return EntryAnswer.of(found, service.board.events(season, digest), bundle)


@router.get(
    "/entries/{season}/{digest}/bundle.zip",
    response_class=Response,
    responses={**MISSING, 200: {"content": {ZIP: {"schema": BINARY}}}},
)
def bundle(service: Service, season: SeasonName, digest: Digest) -> Response:
    """Return the bundle of the public run, as `colift verify` takes it."""
    folder = service.board.bundle(season, digest)
    if folder is None:
        raise problem(404, f"season {season} has no bundle of {digest}")
    file = tempfile.TemporaryFile()  # noqa: SIM115 (it is closed when all is sent)
    pack(folder, file)
    headers = {
        "Content-Length": str(file.tell()),
        "Content-Disposition": f'attachment; filename="{season}-{digest[:16]}.zip"',
    }

    def chunks() -> Iterator[bytes]:
        with file:
            file.seek(0)
            while data := file.read(CHUNK):
                yield data

    return StreamingResponse(chunks(), media_type=ZIP, headers=headers)


def _standings(service: State, season: str | None) -> tuple[Standing, ...]:
    _check_season(service, season)
    return service.board.standings(season)


def _check_season(service: State, season: str | None) -> None:
    names = [each.name for each in service.board.seasons()]
    if season is not None and season not in names:
        raise problem(404, f"there is no season {season}; there are {', '.join(names)}")


def _cells(service: State, standing: Standing) -> tuple[CellScore, ...]:
    bundle = service.board.bundle(standing.row.season, standing.row.submission)
    return () if bundle is None else cell_scores(bundle)


def _check_word(what: str, value: str | None, known: set[str]) -> None:
    """Refuse what no lift has; a season without rows has no lifts to know them by."""
    if value is not None and known and value not in known:
        raise problem(422, f"{what} {value} is not in this season; {', '.join(sorted(known))} are")
