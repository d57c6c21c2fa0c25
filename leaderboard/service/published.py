"""Routes of published data: rules, seasons, standings, entries and bundles."""

from datetime import timedelta
from typing import Final

from colift.agents.submissions.folder import LIMITS
from colift.agents.submissions.packages import PACKAGES
from colift.benchmark.results.strata import StratumScore
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.service.answers import EntryAnswer, RulesAnswer, StandingAnswer
from colift.leaderboard.service.dependencies import (
    BINARY,
    MISSING,
    BehaviourAsked,
    Digest,
    SeasonAsked,
    SeasonName,
    Service,
    ServiceState,
    SubjectAsked,
    api_root,
)
from colift.leaderboard.service.errors import Problem, problem
from colift.leaderboard.service.security import client_of
from colift.leaderboard.service.slots import Slotted
from colift.leaderboard.service.uploads import BODY, ZIP
from colift.leaderboard.views.exports import standings_csv
from colift.leaderboard.views.lifts import stratum_scores
from fastapi import APIRouter, Request, Response
from fastapi.responses import FileResponse
from starlette.concurrency import run_in_threadpool

router: Final = APIRouter()

SENDING_S: Final = 600.0
"""Longest time that a client may take for a bundle [s]."""


@router.get("/seasons")
def seasons(service: Service) -> list[SeasonInfo]:
    """Return all seasons of the board."""
    return list(service.board.seasons())


@router.get("/standings", responses=MISSING)
def get_standings(
    service: Service,
    season: SeasonAsked = None,
    behaviour: BehaviourAsked = None,
    subject: SubjectAsked = None,
) -> list[StandingAnswer]:
    """Return the rows of a season, best first; with the public lifts of a behaviour or subject.

    Ranks are always over all hidden lifts.
    """
    rows = _standings(service, season)
    if behaviour is None and subject is None:
        return [StandingAnswer.of_row(row, None) for row in rows]
    strata = [_strata(service, row) for row in rows]
    _check_word("behaviour", behaviour, {stratum.behaviour for some in strata for stratum in some})
    _check_word("subject", subject, {stratum.subject for some in strata for stratum in some})
    chosen = [
        [
            stratum
            for stratum in some
            if behaviour in (None, stratum.behaviour) and subject in (None, stratum.subject)
        ]
        for some in strata
    ]
    return [StandingAnswer.of_row(row, some) for row, some in zip(rows, chosen, strict=True)]


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
    """Return the outcome of a submission in a season."""
    found = service.board.entry(season, digest)
    if found is None:
        raise problem(404, f"season {season} has no entry {digest}")
    bundle = None
    if service.board.bundle(season, digest) is not None:
        bundle = f"{api_root(request)}/entries/{season}/{digest}/bundle.zip"
    return EntryAnswer.of(found, events=service.board.events(season, digest), bundle=bundle)


@router.get(
    "/entries/{season}/{digest}/bundle.zip",
    response_class=Response,
    responses={
        **MISSING,
        200: {"content": {ZIP: {"schema": BINARY}}},
        206: {"description": "The requested part."},
        304: {"description": "It equals the client's copy."},
        400: {"description": "The Range is malformed."},
        416: {"description": "It is shorter than the Range."},
        503: {"model": Problem, "description": "Too many downloads; see Retry-After."},
    },
)
async def bundle(
    service: Service, request: Request, season: SeasonName, digest: Digest
) -> Response:
    """Return the bundle of the public run, for `colift verify`.

    `If-None-Match` with its `ETag` is answered with 304; `Range` requests a part.
    """
    entry = await run_in_threadpool(service.board.entry, season, digest)
    async with service.packing:  # The first request packs it, the others wait.
        packed = await run_in_threadpool(service.board.store.packed_bundle, season, digest)
    if entry is None or packed is None:
        message = f"season {season} has no bundle of {digest}"
        if entry is not None:
            message += ": the board has lost it; it can come back from a backup of the board"
        raise problem(404, message)
    status = await run_in_threadpool(packed.stat)
    name = f"{season}-{digest[:16]}.zip"
    answer = FileResponse(packed, media_type=ZIP, filename=name, stat_result=status)
    tag = answer.headers["ETag"]
    known = request.headers.get("If-None-Match", "")
    if tag in (each.strip().removeprefix("W/") for each in known.split(",")):
        return Response(status_code=304, headers={"ETag": tag})
    return Slotted(answer, service.sending, client_of(request), SENDING_S)


def _standings(service: ServiceState, season: str | None) -> tuple[RankedRow, ...]:
    _check_season(service, season)
    return service.board.tables.read(service.board.season_info(season).name).rows


def _check_season(service: ServiceState, season: str | None) -> None:
    names = [each.name for each in service.board.seasons()]
    if season is not None and season not in names:
        raise problem(404, f"there is no season {season}; the seasons are {', '.join(names)}")


def _strata(service: ServiceState, standing: RankedRow) -> tuple[StratumScore, ...]:
    bundle = service.board.bundle(standing.row.season, standing.row.submission)
    return () if bundle is None else stratum_scores(bundle)


def _check_word(what: str, value: str | None, known: set[str]) -> None:
    """Refuse a value that no lift has; accept any if there are no rows."""
    if value is not None and known and value not in known:
        raise problem(
            422, f"{what} {value} is not in this season, which has {', '.join(sorted(known))}"
        )


PUBLISHED: Final = (
    "the content of policy.toml: name, authors, description, licence, training data, link",
    "the digest of the files, the submitter's name, and when it was submitted",
    "scores of the public and the hidden lifts, with their intervals",
    "the bundle of the public lifts: motions, actions, and failures with what the policy printed",
    "the reason for having no row, if it has none",
)

PRIVATE: Final = (
    "the files themselves: code and weights",
    "the hidden lifts: only their scores are published",
)


@router.get("/rules")
def rules(service: Service) -> RulesAnswer:
    """Return limits of submissions, quotas, rules of publication, and the maintainer's contact."""
    return rules_of(service)


def rules_of(service: ServiceState) -> RulesAnswer:
    """Return the rules of a service's board."""
    season, quota = service.board.season_info(), service.queue.quota
    return RulesAnswer(
        season=season.name,
        suite=season.suite,
        upload_bytes=BODY,
        files=LIMITS.entries,
        file_bytes=LIMITS.file_bytes,
        total_bytes=LIMITS.total_bytes,
        packages=sorted(PACKAGES),
        open_jobs=quota.open,
        failures=quota.failures,
        rows=quota.rows,
        window_hours=quota.window / timedelta(hours=1),
        kept_bytes=quota.size,
        published=list(PUBLISHED),
        private=list(PRIVATE),
        contact=service.contact or None,
    )
