"""The task of a season: its words, and the options with which its lifts are played at home."""

import functools
import inspect
from dataclasses import dataclass

from colift.base.registry import STANDARD_SUITE, SUITES, entries
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.verification.checking import SUITE as CHECKED
from colift.benchmark.verification.checking import checked_with


@dataclass(frozen=True, kw_only=True)
class TaskView:
    """The texts of pages about a task and its suite."""

    level: bool
    """Whether it is the task ``level``, to which some paragraphs belong."""
    words: str
    """The task as the end of a sentence: the first paragraph of its class's docstring."""
    run: str
    """Option of ``colift run`` that names the suite; empty if that is the default."""
    check: str
    """The same for ``colift check``."""


@functools.cache
def task_view(suite: str) -> TaskView:
    """Return the task of a suite; ``level`` with the options if no suite has that name."""
    if suite not in entries(SUITES):
        named = f" --suite {suite}"
        return TaskView(level=True, words=_words(LEVEL), run=named, check=named)
    made = make_suite(suite)
    task, checked = made.scenarios[0].task, checked_with(made).name
    return TaskView(
        level=task.name == LEVEL.name,
        words=_words(task),
        run="" if suite == STANDARD_SUITE else f" --suite {suite}",
        check="" if checked == CHECKED else f" --suite {checked}",
    )


def _words(task: object) -> str:
    """Return the first paragraph of a docstring in the form that follows a colon."""
    paragraph = (inspect.getdoc(type(task)) or "").partition("\n\n")[0]
    text = " ".join(paragraph.split())
    return text and f"{text[0].lower()}{text[1:].removesuffix('.')}."
