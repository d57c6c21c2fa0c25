"""The lessons by the name of their task."""

from functools import cache

from colift.benchmark.suites.catalogue import make_task
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.training.lesson import PolicyLesson
from colift.benchmark.training.level_lesson import LevelLesson
from colift.benchmark.training.touch_lesson import TouchLesson


@cache
def lesson_of(task: str, *, alone: bool = False) -> PolicyLesson:
    """Return the lesson of a task, and for a network that is blind to its partner if ``alone``.

    Raises
    ------
    InputError
        If there is no such task, or it is neither ``level`` nor stated by rules.
    """
    return LevelLesson() if make_task(task) == LEVEL else TouchLesson(task, alone=alone)
