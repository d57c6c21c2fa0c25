"""The JSON interface, under ``/api/v1``: all that is published, and uploads."""

import tempfile
from collections.abc import Iterator
from typing import Annotated, Any, Final

from fastapi import APIRouter, Depends, Path, Query, Request, Response
from fastapi.responses import StreamingResponse
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer
from starlette.concurrency import run_in_threadpool

from ...agents.submissions.folder import CHUNK
from ..archive import pack
from ..job import Job
from ..standing import Standing
from ..views.lifts import CellScore, cell_scores
from ..views.table import standings_csv
from .answers import EntryAnswer, JobAnswer, SeasonAnswer, StandingAnswer
from .errors import CLOSE, Problem, problem
from .progress import events
from .security import seconds
from .state import Service, State
from .uploads import BODY, ZIP, check_headers, receive_submission

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

router: Final = APIRouter(
    prefix=PREFIX,
    responses={
        422: {"model": Problem, "description": "A value is not what it must be."},
        429: {"model": Problem, "description": "Too many requests; see Retry-After."},
    },
)

_token: Final = HTTPBearer(
    auto_error=False, description="A token, made by: colift token add NAME --board PATH"
)


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
        bundle = f"{_root(request)}/entries/{season}/{digest}/bundle.zip"
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


@router.get("/jobs/{job}", responses=MISSING)
def job(service: Service, job: JobId) -> JobAnswer:
    """Return how far a submission is."""
    return JobAnswer.of(_job(service, job))


@router.get(
    "/jobs/{job}/events",
    response_class=Response,
    responses={
        **MISSING,
        200: {"content": {"text/event-stream": {"schema": {"type": "string"}}}},
        503: {"model": Problem, "description": "Too many listen; ask for the job instead."},
    },
)
async def job_events(service: Service, job: JobId) -> Response:
    """Return the job again whenever it changes, as server-sent events, until it has ended."""
    found = await run_in_threadpool(_job, service, job)
    if service.streams.full:
        raise problem(503, "too many listen already; ask for the job itself", {"Retry-After": "60"})

    async def read() -> JobAnswer | None:
        now = await run_in_threadpool(service.queue.job, job)
        return None if now is None else JobAnswer.of(now)

    return StreamingResponse(
        events(JobAnswer.of(found), read, service.streams),
        media_type="text/event-stream",
        headers={"X-Accel-Buffering": "no"},  # nginx would keep the news to itself
    )


@router.post(
    "/submissions",
    status_code=202,
    responses={
        400: {"model": Problem, "description": "The upload broke off."},
        401: {"model": Problem, "description": "There is no token, or it does not count."},
        408: {"model": Problem, "description": "The upload is too slow."},
        413: {"model": Problem, "description": "The upload is too large."},
        415: {"model": Problem, "description": "The body is no zip archive."},
    },
    openapi_extra={
        "requestBody": {
            "required": True,
            "description": f"A submission's folder as a zip archive of at most {BODY} bytes.",
            "content": {ZIP: {"schema": BINARY}},
        }
    },
)
async def submit(
    service: Service,
    request: Request,
    response: Response,
    credentials: Annotated[HTTPAuthorizationCredentials | None, Depends(_token)],
) -> JobAnswer:
    """Put a submission into the queue; the same content in the same season is one job."""
    submitter = await _submitter(service, credentials)
    check_headers(request)
    wait = service.uploads.wait(submitter)
    if wait:
        told = f"{submitter} has submitted too often; try again in {seconds(wait)} s"
        raise problem(429, told, {**CLOSE, "Retry-After": seconds(wait)})
    async with service.slots:
        submission = await receive_submission(request, service.board)
        queued = await run_in_threadpool(service.queue.enqueue, submission, submitter)
    response.headers["Location"] = f"{_root(request)}/jobs/{queued.id}"
    return JobAnswer.of(queued)


async def _submitter(service: State, credentials: HTTPAuthorizationCredentials | None) -> str:
    """Return who a token belongs to."""
    told = "say who you are: a header 'Authorization: Bearer TOKEN'"
    if credentials is not None:
        known = await run_in_threadpool(service.tokens.submitter, credentials.credentials)
        if known is not None:
            return known
        told = "this token does not count: it is mistyped or has been revoked"
    told = f"{told}; who runs the board makes tokens by: colift token add NAME"
    raise problem(401, told, {**CLOSE, "WWW-Authenticate": "Bearer"})


def _root(request: Request) -> str:
    """Return where the API is, as the client sees it: a proxy may have put it below a path."""
    return f"{request.scope.get('root_path', '').rstrip('/')}{PREFIX}"


def _job(service: State, name: str) -> Job:
    found = service.queue.job(name)
    if found is None:
        raise problem(404, f"there is no job {name}")
    return found


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
