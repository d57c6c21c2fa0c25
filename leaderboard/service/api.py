"""The JSON interface, under ``/api/v1``: all that is published, and uploads."""

from typing import Final

from fastapi import APIRouter

from . import published, submitting
from .asked import PREFIX
from .errors import Problem

router: Final = APIRouter(
    prefix=PREFIX,
    responses={
        422: {"model": Problem, "description": "A value is not what it must be."},
        429: {"model": Problem, "description": "Too many requests; see Retry-After."},
    },
)
router.include_router(published.router)
router.include_router(submitting.router)
