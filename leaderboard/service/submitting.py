"""How the API takes submissions, and tells how far they are."""

from typing import Annotated, Final

from fastapi import APIRouter, Depends, Request, Response
from fastapi.responses import StreamingResponse
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer
from starlette.concurrency import run_in_threadpool

from ..job import Job
from .answers import JobAnswer, SubmitterAnswer
from .asked import BINARY, MISSING, UNKNOWN, JobId, api_root
from .errors import CLOSE, Problem, problem
from .progress import events
from .security import seconds
from .state import Service, State
from .uploads import BODY, ZIP, check_headers, receive_submission

router = APIRouter()

_token: Final = HTTPBearer(
    auto_error=False, description="A token, made by: colift token add NAME --board PATH"
)
Credentials = Annotated[HTTPAuthorizationCredentials | None, Depends(_token)]


@router.get("/me", responses=UNKNOWN)
async def me(service: Service, credentials: Credentials) -> SubmitterAnswer:
    """Return who the token belongs to: to know before an upload that it counts."""
    return SubmitterAnswer(submitter=await _submitter(service, credentials))


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
        **UNKNOWN,
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
    credentials: Credentials,
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
    response.headers["Location"] = f"{api_root(request)}/jobs/{queued.id}"
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


def _job(service: State, name: str) -> Job:
    found = service.queue.job(name)
    if found is None:
        raise problem(404, f"there is no job {name}")
    return found
