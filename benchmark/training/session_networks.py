"""Networks for sessions, trained alike, that differ in what they keep or are told."""

from collections.abc import Callable
from typing import get_args

from colift.agents.control.recurrent import GatedNetwork, network_of
from colift.benchmark.suites.suite import Suite
from colift.benchmark.training.apg import first_learner, updates
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.session_kinds import Kind
from colift.benchmark.training.session_lesson import SessionLesson, SessionPool


def train_kinds(
    suite: Suite, settings: ApgSettings, progress: Callable[[int], None] = lambda updates: None
) -> dict[Kind, GatedNetwork]:
    """Return trained networks of each kind, with one budget, in double precision.

    Parameters
    ----------
    suite
        The suite of sessions; they learn from other people.
    settings
        The budget: updates, lifts, batch, units and rate.
    progress
        Called with the number of updates since the last call.
    """
    found: dict[Kind, GatedNetwork] = {}
    pool: SessionPool | None = None
    for kind in get_args(Kind):
        lesson = SessionLesson(suite, kind)
        pool = pool or lesson.draw(settings)
        learner = first_learner(settings, 0, lesson)
        for update in updates(settings, 0, learner, pool, lesson):
            learner = update.learner
            progress(1)
        inputs = learner.network.inputs.shape[1]
        found[kind] = network_of(lesson.weights(learner.network), "trained weights", inputs)
    return found
