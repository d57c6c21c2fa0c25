"""The pages of the service; they need no login."""

import contextlib
from typing import Annotated, Any, Final

from colift.agents.errors import InputError
from colift.leaderboard.evaluation.progress import HIDDEN
from colift.leaderboard.pages.formats import badge_text
from colift.leaderboard.pages.rendering import prose, render_page, template_archive
from colift.leaderboard.replays.chosen import has_replays, replays_of
from colift.leaderboard.replays.html import KEYS, SCRIPTS, replay_data, replay_files, replay_page
from colift.leaderboard.service.dependencies import (
    Service,
    ServiceState,
    links_of,
    origin_of,
    service_state,
)
from colift.leaderboard.service.published import rules_of
from colift.leaderboard.views.asked import Asked
from colift.leaderboard.views.board import board_view, find_season, ordered_seasons
from colift.leaderboard.views.compare import compare_view
from colift.leaderboard.views.exports import news_of
from colift.leaderboard.views.job import job_view, open_jobs
from colift.leaderboard.views.method import method_view
from colift.leaderboard.views.policy import PolicyView, policy_view
from colift.leaderboard.views.scenario import scenario_view, scenarios_view
from fastapi import APIRouter, Depends, Path, Query, Request
from fastapi.responses import HTMLResponse, Response

SUBMISSIONS: Final = "/api/v1/submissions"
JOBS: Final = "/api/v1/jobs"
MINE: Final = "/api/v1/me/submissions"

SeasonName = Annotated[str, Path(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,39}$")]
Digest = Annotated[str, Path(pattern="^[0-9a-f]{64}$")]
Chosen = Annotated[list[str] | None, Query(max_length=20)]


def _question(request: Request) -> Asked:
    """Return what the address asks of a table; of a name that comes twice, the last value."""
    given = request.query_params
    names = ("q", "sort", "behaviour", "subject", "columns", "first")
    return Asked.read(p=given.getlist("p"), **{name: given.get(name, "") for name in names})


Question = Annotated[Asked, Depends(_question)]

router: Final = APIRouter(include_in_schema=False, default_response_class=HTMLResponse)


@router.get("/")
def front(service: Service, request: Request, asked: Question) -> HTMLResponse:
    """Show the board of the current season."""
    return _board(service, request, None, asked)


@router.get("/seasons/{season}")
def season_board(
    service: Service, request: Request, season: SeasonName, asked: Question
) -> HTMLResponse:
    """Show the board of a season."""
    return _board(service, request, season, asked)


@router.get("/seasons/{season}/policies/{digest}")
def submission_page(
    service: Service, request: Request, season: SeasonName, digest: Digest
) -> HTMLResponse:
    """Show a submission."""
    view = policy_view(service.board, season, digest)
    if view is None:
        return _missing(service, request, f"Season {season} has no submission {digest[:16]}.")
    if not isinstance(view, PolicyView):
        return _page(request, "refusal.html", view=view)
    bundle = service.board.bundle(season, digest)
    replays = bundle is not None and has_replays(bundle)
    return _page(request, "policy.html", view=view, has_replays=replays)


@router.get("/seasons/{season}/policies/{digest}/badge.svg", response_class=Response)
def badge_svg(service: Service, request: Request, season: SeasonName, digest: Digest) -> Response:
    """Send the badge of a row, for other sites."""
    found = service.board.tables.row(season, digest)
    if found is None:
        return _missing(service, request, f"Season {season} has no row {digest[:16]}.")
    svg = render_page("badge.svg", links_of(request), text=badge_text(found))
    headers = {"Cross-Origin-Resource-Policy": "cross-origin", "Cache-Control": "max-age=300"}
    return Response(svg, media_type="image/svg+xml", headers=headers)


@router.get("/seasons/{season}/feed.atom", response_class=Response)
def feed(service: Service, request: Request, season: SeasonName) -> Response:
    """Send the rows of a season, newest first."""
    news = news_of(service.board, season)
    if news is None:
        return _missing(service, request, f"There is no season {season}.")
    text = render_page("feed.xml", links_of(request), news=news, prefix=origin_of(request))
    return Response(text, media_type="application/atom+xml")


@router.get("/seasons/{season}/policies/{digest}/replays")
def replays(service: Service, request: Request, season: SeasonName, digest: Digest) -> HTMLResponse:
    """Show lifts of a submission."""
    info = find_season(ordered_seasons(service.board), season)
    entry = service.board.entry(season, digest)
    found = _replays(service, season, digest)
    if info is None or entry is None or not found:
        return _missing(service, request, "There are no replays of this submission.")
    return _page(
        request,
        "replays.html",
        season=info,
        digest=digest,
        name=entry.name,
        replays=replay_data(found),
        files=replay_files(found),
        scripts=SCRIPTS,
        keys=KEYS,
    )


@router.get("/seasons/{season}/policies/{digest}/replays/{name}.html")
def replay_file(
    service: Service, request: Request, season: SeasonName, digest: Digest, name: str
) -> HTMLResponse:
    """Send one lift of a submission as a self-contained file."""
    found = replay_files(_replays(service, season, digest))
    if name not in found:
        return _missing(service, request, "There is no such replay.")
    disposition = f'attachment; filename="{digest[:16]}-{name}.html"'
    page = replay_page([found[name]])
    return HTMLResponse(page, headers={"Content-Disposition": disposition})


@router.get("/seasons/{season}/compare")
def compare_page(
    service: Service, request: Request, season: SeasonName, p: Chosen = None
) -> HTMLResponse:
    """Compare some policies."""
    view = compare_view(service.board, season, p or [])
    if view is None:
        return _missing(service, request, f"There is no season {season}.")
    return _page(request, "compare.html", view=view, asked=p)


@router.get("/seasons/{season}/scenarios")
def scenarios(service: Service, request: Request, season: SeasonName) -> HTMLResponse:
    """Show the list of the scenarios."""
    view = scenarios_view(service.board, season)
    if view is None:
        return _missing(
            service, request, f"This colift does not play the suite of season {season}."
        )
    return _page(request, "scenarios.html", view=view)


@router.get("/seasons/{season}/scenarios/{behaviour}/{subject}")
def scenario_page(
    service: Service, request: Request, season: SeasonName, behaviour: str, subject: str
) -> HTMLResponse:
    """Show a scenario."""
    view = scenario_view(service.board, season, behaviour, subject)
    if view is None:
        return _missing(service, request, f"Season {season} has no such scenario.")
    return _page(request, "scenario.html", view=view)


@router.get("/method")
def method(service: Service, request: Request) -> HTMLResponse:
    """Explain the numbers."""
    return _page(request, "method.html", view=method_view(service.board))


@router.get("/open")
def open_questions(service: Service, request: Request) -> HTMLResponse:
    """Show the open questions."""
    info = find_season(ordered_seasons(service.board), None)
    return _page(request, "open.html", season=info, text=prose("open.md"))


@router.get("/template.zip", response_class=Response)
def template_zip() -> Response:
    """Send the template of a submission."""
    headers = {"Content-Disposition": 'attachment; filename="my-policy.zip"'}
    return Response(template_archive(), media_type="application/zip", headers=headers)


@router.get("/submit")
def submit_page(service: Service, request: Request) -> HTMLResponse:
    """Show the form for submissions, and the queue."""
    view = method_view(service.board)
    root = links_of(request).root
    return _page(
        request,
        "submit.html",
        season=view.season,
        lifts=view.lifts,
        jobs=open_jobs(service.queue),
        api=root + SUBMISSIONS,
        mine=root + MINE,
        rules=rules_of(service),
        address=service.address,
    )


@router.get("/jobs/{job}")
def job_page(
    service: Service, request: Request, job: Annotated[str, Path(pattern="^[0-9a-f]{32}$")]
) -> HTMLResponse:
    """Show the progress of a submission; only its submitter knows the address."""
    view = job_view(service.board, service.queue, job)
    if view is None:
        return _missing(service, request, "There is no such job.")
    info = find_season(ordered_seasons(service.board), view.job.season)
    api = f"{links_of(request).root}{JOBS}/{job}"
    return _page(request, "job.html", season=info, view=view, api=api, hidden=HIDDEN)


def _replays(service: ServiceState, season: str, digest: str) -> list[dict[str, Any]]:
    """Return the replays of a submission; none if this colift no longer plays its suite."""
    entry = service.board.entry(season, digest)
    bundle = service.board.bundle(season, digest)
    with contextlib.suppress(InputError):
        return [] if entry is None or bundle is None else replays_of(bundle, entry.name)
    return []


def _board(
    service: ServiceState, request: Request, season: str | None, asked: Asked
) -> HTMLResponse:
    view = board_view(service.board, season, asked)
    if view is None:
        return _missing(service, request, f"There is no season {season}.")
    return _page(request, "board.html", view=view)


def missing_page(request: Request, message: str) -> HTMLResponse:
    """Return the page for an address of nothing."""
    return _missing(service_state(request), request, message)


def _missing(service: ServiceState, request: Request, message: str) -> HTMLResponse:
    season = find_season(ordered_seasons(service.board), None)
    return _page(request, "missing.html", status=404, season=season, message=message)


def _page(request: Request, template: str, *, status: int = 200, **content: Any) -> HTMLResponse:
    return HTMLResponse(render_page(template, links_of(request), **content), status)
