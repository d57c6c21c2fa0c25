"""The lessons by the name of their task."""

from functools import cache

from colift.benchmark.suites.catalogue import make_task
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lesson import PolicyLesson
from colift.benchmark.training.level_lesson import LevelLesson
from colift.benchmark.training.session_kinds import SESSIONS, Kind
from colift.benchmark.training.session_lesson import SessionLesson
from colift.benchmark.training.touch_lesson import TouchLesson


def lesson_for(settings: ApgSettings) -> PolicyLesson:
    """Return the lesson of some settings; raise an InputError as :func:`lesson_of`."""
    if settings.session:
        return _session_lesson(settings.session)
    return lesson_of(settings.task, alone=settings.alone)


@cache
def _session_lesson(kind: Kind) -> PolicyLesson:
    return SessionLesson(make_suite(SESSIONS), kind)


@cache
def lesson_of(task: str, *, alone: bool = False) -> PolicyLesson:
    """Return the lesson of a task, and for a network that is blind to its partner if ``alone``.

    Raises
    ------
    InputError
        If there is no such task, or it is neither ``level`` nor stated by rules.
    """
    return LevelLesson() if make_task(task) == LEVEL else TouchLesson(task, alone=alone)
