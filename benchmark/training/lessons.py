"""The lessons by the name of their task."""

from .apg_settings import TASKS
from .lesson import Lesson
from .level_lesson import LevelLesson
from .touch_lesson import TouchLesson


def lesson_of(task: str) -> Lesson:
    """Return the lesson of a task of :data:`.TASKS`."""
    return LevelLesson() if task == TASKS[0] else TouchLesson(task)
