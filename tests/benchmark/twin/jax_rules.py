"""The rules of every task: the same as numbers in the engine and as arrays in the twin."""

import contextlib
from dataclasses import replace

import jax
import pytest
from colift.agents.agent import FRAME
from colift.agents.policies.copy import Copy
from colift.base.errors import InputError
from colift.base.registry import TASKS, own_entries
from colift.benchmark.episode.lift import Lift
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.ball.person import Steers
from colift.benchmark.twin.agreement import CLOSE, largest_difference
from colift.benchmark.twin.drawing import draw_lift

WITH_RULES = [name for name in own_entries(TASKS) if make_task(name).touch]


@pytest.mark.parametrize("name", WITH_RULES)
def test_a_lift_has_the_numbers_of_the_engine_in_double_precision(name):
    scenario = make_scenario(make_task(name).behaviours[-1], "draw-210007", task=name)
    assert largest_difference(scenario, 7, Copy) < CLOSE


@pytest.mark.parametrize(("name", "period"), [*zip(WITH_RULES, (0.05, 0.2, 0.2), strict=True)])
def test_other_periods_have_them_too(name, period):
    behaviour = make_task(name).behaviours[0]
    scenario = make_scenario(behaviour, "S3", task=name, control_period=period, latency=0.15)
    assert largest_difference(scenario, 3, Copy) < CLOSE


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"task": "ball", "partner": "human"}, "the twin of 'ball' models 'nao', not 'human'"),
        ({"partner": "iiwa"}, "the twin of 'level' models 'nao' or 'human', not 'iiwa'"),
    ],
)
def test_what_the_twin_does_not_model_is_refused(settings, message):
    with pytest.raises(InputError, match=message):
        draw_lift(make_scenario("smooth", **settings), 0)


class Deciding(Steers):
    """A person whose rule has an if."""

    def intend(self, f, drawn, memory, view, frames):
        if view.seen("ball_place", 0) > 0.0:
            return super().intend(f, drawn, memory, view, frames)
        return super().intend(f, drawn, memory, view, frames)


class Slipping(Steers):
    """A person whose rule differs a little for arrays."""

    def drive(self, f, drawn, intention, reference):
        difference, pitch = super().drive(f, drawn, intention, reference)
        return difference, pitch * (1.0 + 1e-6 * hasattr(f, "nothing"))


def test_an_if_is_found(monkeypatch):
    monkeypatch.setattr(type(make_task("ball")), "person", Deciding())
    with pytest.raises(jax.errors.TracerBoolConversionError):
        largest_difference(make_scenario("ball_smooth", "S1", task="ball"), 0, Copy)


def test_a_slip_is_found(monkeypatch):
    monkeypatch.setattr("colift.benchmark.twin.functions.LiftFunctions.nothing", 0, raising=False)
    task = make_task("ball")
    monkeypatch.setattr(type(task), "person", Slipping())
    assert largest_difference(make_scenario("ball_smooth", "S1", task="ball"), 7, Copy) > CLOSE


def test_at_long_periods_people_see_their_own_height_as_old_as_their_sight(monkeypatch):
    """Not ten frames older, as when they kept the last ten of twenty frames."""
    scenario = make_scenario("ball_smooth", "S2", task="ball", control_period=0.2)
    seen = []

    class Noting(Steers):
        def intend(self, f, drawn, memory, view, frames):
            seen.append((view.frame, view.visual))
            return super().intend(f, drawn, memory, view, frames)

    monkeypatch.setattr(type(scenario.task), "person", Noting())
    with contextlib.closing(Lift(replace(scenario))) as lift:
        lift.reset(2)
        assert lift.visual == round(scenario.subject.visual_delay / FRAME)
        human = lift.human()
        lift.step(human.references(), [0.0])
        assert lift.seen("human_end", lift.visual) == lift.world.human_end[-1 - lift.visual]
    assert [frame for frame, _ in seen] == [0, 20]
