"""The second human of the human-human baseline."""

from functools import partial

import numpy as np
import pytest
from colift.agents.agent import HumanObservation
from colift.agents.humans import SECOND_PERSON, SecondPerson
from colift.agents.humans.felt import FELT_HEIGHT, SUPPORT
from colift.agents.humans.second_person import SecondPersonParameters
from colift.agents.loading.policy_spec import InMemorySpec
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.world.table import GRIP_STIFFNESS, TABLE_LENGTH, WEIGHT_SHARE


def view(own, other, frames=10, force=0.0):
    """Return an observation of the last heights of both ends, and of a force [N]."""
    seen = np.zeros(HumanObservation.size(frames))
    seen[HumanObservation.HAND_FORCE] = SUPPORT + force
    seen[HumanObservation.OWN_HEIGHT] = own[-10:]
    seen[HumanObservation.OTHER_END] = other[-10:]
    return seen


def noiseless(lag):
    """Return a partner whose noise is too small to matter here."""
    partner = SecondPerson(parameters=SecondPersonParameters(lag=lag, velocity_memory=0.02))
    partner.reset(1)
    return partner


def follow(partner, path, steps):
    """Show the path, ``visual_delay`` late, to a partner whose hand is where it means to be.

    Returns the references of the last step and the frame at which it began.
    """
    last = np.zeros(10)
    delay = round(SECOND_PERSON.visual_delay / 0.01)
    for step in range(steps):
        now = 10 * (step + 1)
        last = partner.act(view(last, path[now - delay - 10 + 60 : now - delay + 60]))
    return last, now


@pytest.mark.parametrize("lag", [0.0, 0.05])
def test_it_is_where_a_steady_mover_will_be_but_for_its_lag(lag):
    speed = 0.05
    path = speed * 0.01 * np.arange(-59, 400)
    references, now = follow(noiseless(lag), path, 30)
    there = speed * 0.01 * (now + np.arange(1, 11)) - speed * lag
    # The hand's own noise and slow correction remain: a few millimetres.
    assert np.abs(references - there).max() < 0.006


def test_it_stays_with_somebody_who_stands_still():
    references, _ = follow(noiseless(0.05), np.full(400, 0.1), 30)
    assert references == pytest.approx(np.full(10, 0.1), abs=0.006)
    assert np.ptp(references) < 0.004


def test_the_same_seed_gives_the_same_bits_and_another_does_not():
    path = 0.1 * np.sin(np.arange(400) / 40)
    runs = []
    for seed in (3, 3, 4):
        partner = SecondPerson()
        partner.reset(seed)
        runs.append(follow(partner, path, 20)[0].tobytes())
    assert runs[0] == runs[1] != runs[2]


@pytest.mark.parametrize("frames", [1, 5, 10, 20])
def test_it_acts_at_every_control_period(frames):
    partner = noiseless(0.04)
    for step in range(30):
        last = frames * (step + 1)
        other = 0.0005 * np.arange(last - 9, last + 1)
        references = partner.act(view(other, other, frames))
    assert references.shape == (frames,)
    assert np.isfinite(references).all()
    speed = np.diff(references).mean() if frames > 1 else 0.0005
    assert speed == pytest.approx(0.0005, abs=0.0002)


def test_people_know_their_table():
    assert pytest.approx(WEIGHT_SHARE) == SUPPORT
    assert pytest.approx(TABLE_LENGTH**2 / GRIP_STIFFNESS) == FELT_HEIGHT


def test_it_gives_way_to_what_it_feels():
    """1 N more than the weight is felt as an own end 64 mm above the other one."""
    still = np.full(10, 0.1)
    heights = []
    for force in (0.0, 1.0):
        partner = noiseless(0.05)
        heights.append(partner.act(view(still, still, force=force))[-1])
    assert heights[0] - heights[1] == pytest.approx(0.12 * 0.064, rel=0.03)


@pytest.mark.parametrize(("yielding", "swings"), [(0.12, False), (0.24, False), (0.5, True)])
def test_a_pair_swings_only_with_far_more_yielding(yielding, swings):
    parameters = SecondPersonParameters(yielding=yielding)
    spec = InMemorySpec(
        name="pair", factory=partial(SecondPerson, parameters=parameters), source=SecondPerson
    )
    (episode,) = play(spec, make_scenario("smooth", "S1", "human"), (0,))
    assert (episode.scores["rmse_mm"] > 100.0) is swings
