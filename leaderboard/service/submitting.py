"""Routes for submissions and their jobs."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import Annotated, Final

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.leaderboard.records.job import Job
from colift.leaderboard.service.answers import JobAnswer, SubmissionAnswer, SubmitterAnswer
from colift.leaderboard.service.dependencies import (
    BINARY,
    MISSING,
    UNKNOWN,
    JobId,
    Service,
    ServiceState,
    api_root,
)
from colift.leaderboard.service.errors import CLOSE, Problem, problem
from colift.leaderboard.service.security import client_of, seconds
from colift.leaderboard.service.slots import Slotted
from colift.leaderboard.service.uploads import BODY, ZIP, check_headers, received
from fastapi import APIRouter, Depends, Request, Response
from fastapi.responses import StreamingResponse
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

POLL_S: Final = 1.0
"""Time between two queries of the database [s]."""

ALIVE_S: Final = 15.0
"""Time without news after which a comment is sent [s], so that no proxy closes the connection."""

LONGEST_S: Final = 3600.0
"""Time after which a stream ends [s]; a browser reconnects by itself."""


async def events(
    first: JobAnswer, read: Callable[[], Awaitable[JobAnswer | None]]
) -> AsyncIterator[bytes]:
    """Yield an event ``job`` whenever the job has changed, until it has ended.

    Parameters
    ----------
    first
        The job at the beginning.
    read
        Returns the present job, or raises an error if the database is away.
    """
    clock = asyncio.get_running_loop().time
    began = reported = clock()
    job: JobAnswer | None = first
    yield _event(first)
    while job and job.ended_at is None and clock() - began < LONGEST_S:
        await asyncio.sleep(POLL_S)
        try:
            now = await read()
        except sa.exc.OperationalError:
            now = job  # The database may come back.
        if now != job and now is not None:
            yield _event(now)
            reported = clock()
        elif clock() - reported > ALIVE_S:
            yield b": still here\n\n"
            reported = clock()
        job = now


def _event(job: JobAnswer) -> bytes:
    return f"event: job\ndata: {job.model_dump_json()}\n\n".encode()


router = APIRouter()

REVOKED: Final = "this token is not valid: it is mistyped or has been revoked"

CANCELLED: Final = "at the submitter's request"
"""Reason of a cancellation over the web."""

MINE: Final = 50
"""Maximum number of listed submissions of a submitter."""

_token: Final = HTTPBearer(
    auto_error=False, description="A token, from the maintainer of the board"
)
Credentials = Annotated[HTTPAuthorizationCredentials | None, Depends(_token)]


@router.get("/me", responses=UNKNOWN)
async def me(service: Service, credentials: Credentials) -> SubmitterAnswer:
    """Return the token's owner, to check a token before an upload."""
    return SubmitterAnswer(submitter=await _submitter(service, credentials))


@router.get("/me/submissions", responses=UNKNOWN)
async def submissions(
    service: Service, request: Request, credentials: Credentials
) -> list[SubmissionAnswer]:
    """Return the last submissions of the token's owner, newest first."""
    submitter = await _submitter(service, credentials)
    found = await run_in_threadpool(service.queue.jobs, limit=MINE, submitter=submitter)
    return [SubmissionAnswer.of_job(each, api_root(request)) for each in found]


@router.get("/jobs/{job}", responses=MISSING)
def get_job(service: Service, job: JobId) -> JobAnswer:
    """Return a submission and its progress."""
    return _answer(service, _job(service, job))


@router.delete(
    "/jobs/{job}",
    responses={
        **MISSING,
        **UNKNOWN,
        403: {"model": Problem, "description": "It is another submitter's job."},
        409: {"model": Problem, "description": "It has ended."},
    },
)
async def delete_job(service: Service, job: JobId, credentials: Credentials) -> JobAnswer:
    """Take a submission out of the queue, or stop its evaluation, as its submitter."""
    submitter = await _submitter(service, credentials)
    found = await run_in_threadpool(_job, service, job)
    if found.submitter != submitter:
        raise problem(403, f"job {job} is not {submitter}'s")
    try:
        ended = await run_in_threadpool(service.queue.cancel, job, submitter, CANCELLED, submitter)
    except InputError as error:
        raise problem(409, f"job {job} has ended") from error
    return JobAnswer.of(ended, unattended=None)


@router.get(
    "/jobs/{job}/events",
    response_class=Response,
    responses={
        **MISSING,
        200: {"content": {"text/event-stream": {"schema": {"type": "string"}}}},
        503: {"model": Problem, "description": "Too many streams; request the job instead."},
    },
)
async def job_events(service: Service, request: Request, job: JobId) -> Response:
    """Return the job again whenever it changes, as server-sent events, until it has ended."""
    found = await run_in_threadpool(_job, service, job)

    async def read() -> JobAnswer | None:
        now = await run_in_threadpool(service.queue.job, job)
        return None if now is None else await run_in_threadpool(_answer, service, now)

    news = StreamingResponse(
        events(await run_in_threadpool(_answer, service, found), read),
        media_type="text/event-stream",
        headers={"X-Accel-Buffering": "no"},  # else nginx would buffer the stream
    )
    return Slotted(news, service.streams, client_of(request), 2 * LONGEST_S)


@router.post(
    "/submissions",
    status_code=202,
    responses={
        400: {"model": Problem, "description": "The upload broke off."},
        **UNKNOWN,
        408: {"model": Problem, "description": "The upload is too slow."},
        413: {"model": Problem, "description": "The upload is too large."},
        415: {"model": Problem, "description": "The body is not a zip archive."},
        503: {"model": Problem, "description": "Too many uploads; see Retry-After."},
    },
    openapi_extra={
        "requestBody": {
            "required": True,
            "description": f"A submission's folder as a zip archive of at most {BODY} bytes.",
            "content": {ZIP: {"schema": BINARY}},
        }
    },
)
async def post_submission(
    service: Service,
    request: Request,
    response: Response,
    credentials: Credentials,
) -> JobAnswer:
    """Put a submission into the queue; the same content in the same season is one job."""
    submitter = await _submitter(service, credentials)
    check_headers(request)
    wait = service.uploads.wait(submitter)
    if wait:
        message = f"{submitter} has submitted too often; try again in {seconds(wait)} s"
        raise problem(429, message, {**CLOSE, "Retry-After": seconds(wait)})
    async with service.receiving.held(submitter), received(request, service) as incoming:

        def place() -> None:
            if _known(service, credentials) != submitter:
                raise _nobody(REVOKED)  # While the upload was under way.
            incoming.place()

        queued = await run_in_threadpool(
            service.queue.enqueue, incoming.submission, submitter, place
        )
    response.headers["Location"] = f"{api_root(request)}/jobs/{queued.id}"
    return await run_in_threadpool(_answer, service, queued)


async def _submitter(
    service: ServiceState, credentials: HTTPAuthorizationCredentials | None
) -> str:
    """Return a token's owner."""
    if credentials is None:
        raise _nobody("no token was given, in a header 'Authorization: Bearer TOKEN'")
    known = await run_in_threadpool(_known, service, credentials)
    if known is None:
        raise _nobody(REVOKED)
    return known


def _known(service: ServiceState, credentials: HTTPAuthorizationCredentials | None) -> str | None:
    return None if credentials is None else service.tokens.submitter(credentials.credentials)


def _nobody(message: str) -> HTTPException:
    message = f"{message}; ask the maintainer of the board for a token"
    return problem(401, message, {**CLOSE, "WWW-Authenticate": "Bearer"})


def _answer(service: ServiceState, job: Job) -> JobAnswer:
    return JobAnswer.of(job, unattended=service.queue.unattended(job))


def _job(service: ServiceState, name: str) -> Job:
    found = service.queue.job(name)
    if found is None:
        raise problem(404, f"there is no job {name}")
    return found
