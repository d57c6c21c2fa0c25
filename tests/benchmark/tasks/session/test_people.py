"""People with habits, who learn about their partner: by the published equations, and as stated."""

import dataclasses
import itertools
from contextlib import closing

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import Subject
from colift.agents.humans.serial import Serial
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.rules import SCALARS
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.session.acquaintance import (
    STRANGER,
    Acquaintance,
    Impression,
    after_lift,
    impression,
)
from colift.benchmark.tasks.session.habitual import Habitual
from colift.benchmark.tasks.session.usual import CHANGES, CHANGING, usual_lift

PEOPLE = [Subject.draw(200_000 + i) for i in range(60)]


def lift(lag, noise=0.0):
    """Return both ends of a lift in which the far one is late [s] and unsteady [m]."""
    time = FRAME * np.arange(900)
    height = 0.1 * (1 - np.cos(2 * np.pi * np.clip(time - 1.0, 0, 6) / 6))
    far = np.interp(time - lag, time, height)
    far += noise * np.sin(2 * np.pi * 1.3 * time)
    return height.tolist(), far.tolist()


@pytest.mark.parametrize("lag", [-0.1, 0.0, 0.05, 0.2])
def test_a_person_sees_by_how_much_the_partner_is_late(lag):
    seen = impression(SCALARS, *lift(lag))
    assert seen.lag == pytest.approx(lag, abs=0.002)
    assert seen.unexplained < 0.03**2


def test_what_no_lag_explains_is_seen_too():
    calm, rough = (impression(SCALARS, *lift(0.1, noise)) for noise in (0.0, 0.02))
    assert rough.lag == pytest.approx(calm.lag, abs=0.01)
    assert rough.unexplained > 20 * calm.unexplained


def test_a_lift_in_which_nobody_moves_tells_nothing():
    assert impression(SCALARS, [0.0] * 300, [0.0] * 300) == Impression(0.0, 0.0)


def test_learning_and_forgetting_have_two_rates():
    """The numbers are those of Smith et al. (2006), worked out by hand for the first trials."""
    once = after_lift(SCALARS, STRANGER, Impression(0.1, 0.0))
    fast, slow = 0.021, 0.002  # B e, with e = 0.1.
    error = 0.1 - fast - slow
    fast, slow = 0.59 * fast + 0.21 * error, 0.992 * slow + 0.02 * error
    assert (once.fast, once.slow) == pytest.approx((fast, slow))
    known = STRANGER
    for _ in range(200):
        known = after_lift(SCALARS, known, Impression(0.1, 0.0))
    # At rest: x_i = A_i x_i + B_i e for both.
    gain = 0.21 / 0.41 + 0.02 / 0.008
    assert known.lag == pytest.approx(0.1 * gain / (1 + gain), rel=0.01)
    without = after_lift(SCALARS, known, Impression(known.lag, 0.0))
    assert without.fast < 0.7 * known.fast
    assert without.slow > 0.97 * known.slow


def test_trust_follows_the_evidence():
    trusting = distrusting = STRANGER
    for _ in range(10):
        trusting = after_lift(SCALARS, trusting, Impression(0.1, 0.0))
        distrusting = after_lift(SCALARS, distrusting, Impression(0.1, 0.2**2))
    assert trusting.trust > 0.95
    assert distrusting.trust < 0.1


def test_a_person_has_habits_and_most_change_one_of_them_once():
    changed = 0
    for person in PEOPLE:
        found = [usual_lift(person, place) for place in range(10)]
        eras = [habits for habits, _ in itertools.groupby(found)]
        assert len(eras) in (1, 2)
        if len(eras) == 2:
            changed += 1
            assert found.index(eras[1]) in CHANGES
            differing = {
                name for name in eras[0]._fields if getattr(eras[0], name) != getattr(eras[1], name)
            }
            groups = {"wait", "hold"}, {"height", "up", "down"}, {"way", "at", "length", "size"}
            assert any(differing <= group for group in groups)
    assert changed / len(PEOPLE) == pytest.approx(CHANGING, abs=0.2)


def test_lifts_of_a_person_are_more_alike_than_those_of_two():
    def waits(person):
        events = (Habitual().plan(person, seed).events for seed in range(6))
        return [dict(each)["hold"] for each in events]

    every = np.array([waits(person) for person in PEOPLE[:20]])
    assert every.std(axis=1).mean() < 0.25 * every.mean(axis=1).std()


def test_without_habits_each_lift_is_somebody_elses():
    fickle = Habitual(steady=False)
    tops = [fickle.plan(PEOPLE[0], seed).goal for seed in range(20)]
    usual = [Habitual().plan(PEOPLE[0], seed).goal for seed in range(20)]
    assert np.std(tops) > 3 * np.std(usual)


def test_the_behaviour_of_the_next_lift_knows_this_one():
    first = Habitual()
    assert isinstance(first, Serial)
    second = first.after(*lift(0.1))
    assert (second.place, second.counted) == (1, first.counted)
    assert second.known == after_lift(SCALARS, STRANGER, impression(SCALARS, *lift(0.1)))
    assert second.rules.known == second.known
    assert first.at(4) == dataclasses.replace(first, place=4)
    assert first.after((), ()) == first.at(1)


def test_a_person_who_trusts_helps_more():
    """The same slow partner: whoever trusts it goes more slowly, and is less far from it."""
    errors = []
    for trust, person in itertools.product((0.0, 1.0), range(200_000, 200_008)):
        human = Habitual(known=Acquaintance(0.1, 0.05, trust))
        scenario = dataclasses.replace(make_scenario("habitual", f"draw-{person}"), human=human)
        with closing(Lift(scenario)) as made, PolicySpec(text="copy").agent() as agent:
            errors.append(run_episode(made, agent, 0).scores["rmse_mm"])
    distrusting, trusting = np.array(errors).reshape(2, -1).mean(axis=1)
    assert trusting < 0.93 * distrusting
