"""The lessons by the name of their task."""

from functools import cache

from .apg_settings import TASKS
from .lesson import PolicyLesson
from .level_lesson import LevelLesson
from .touch_lesson import TouchLesson


@cache
def lesson_of(task: str) -> PolicyLesson:
    """Return the lesson of a task of :data:`.TASKS`."""
    return LevelLesson() if task == TASKS[0] else TouchLesson(task)
