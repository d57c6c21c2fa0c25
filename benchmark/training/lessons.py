"""The lessons by the name of their task."""

from functools import cache

from colift.benchmark.training.apg_settings import TASKS
from colift.benchmark.training.lesson import PolicyLesson
from colift.benchmark.training.level_lesson import LevelLesson
from colift.benchmark.training.touch_lesson import TouchLesson


@cache
def lesson_of(task: str) -> PolicyLesson:
    """Return the lesson of a task of :data:`.TASKS`."""
    return LevelLesson() if task == TASKS[0] else TouchLesson(task)
