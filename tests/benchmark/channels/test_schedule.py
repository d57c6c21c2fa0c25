"""The order of events on a channel."""

import math
import subprocess
import sys
from itertools import islice

import numpy as np
import pytest
from colift.benchmark.channels import CHANNELS, Channel, Link
from colift.benchmark.channels.schedule import schedule
from scipy.stats import gamma, lognorm

FRAMES = 10
"""Frames per step: 100 ms."""


def turns(channel, steps, seed=1):
    return list(islice(schedule(channel, FRAMES, seed), steps))


def answered(channel, steps, seed=1):
    return [turn.answered for turn in turns(channel, steps, seed)]


def test_without_delay_each_observation_is_answered_in_its_own_step():
    assert answered(Channel(), 50) == list(range(50))


@pytest.mark.parametrize(
    ("delay", "steps"), [(0.004, 0), (0.005, 1), (0.1, 1), (0.104, 1), (0.11, 2)]
)
@pytest.mark.parametrize("name", ["down", "up"])
def test_a_constant_delay_is_a_whole_number_of_steps_at_last(name, delay, steps):
    channel = Channel(**{name: Link(delay=delay)})
    assert answered(channel, 20) == [None] * steps + list(range(20 - steps))


def test_delays_of_both_directions_add_up_before_they_are_rounded_to_steps():
    link = Link(delay=0.05)
    assert answered(Channel(down=link, up=link), 5) == [None, 0, 1, 2, 3]
    link = Link(delay=0.06)
    assert answered(Channel(down=link, up=link), 5) == [None, None, 0, 1, 2]


def test_a_shorter_period_waits_for_fewer_frames():
    found = islice(schedule(Channel(up=Link(delay=0.04)), 2, 1), 5)
    assert [turn.answered for turn in found] == [None, None, 0, 1, 2]


def test_total_loss_lets_nothing_arrive():
    for name in ("down", "up"):
        found = turns(Channel(**{name: Link(loss=1.0)}), 50)
        assert all(turn.answered is None for turn in found)
        assert all(turn.seen == (() if name == "down" else (k,)) for k, turn in enumerate(found))


def test_old_messages_are_ignored():
    """With jitter above the period messages overtake each other, both ways."""
    wild = Link(jitter_mean=0.3, jitter_deviation=0.3)
    for channel in (Channel(down=wild), Channel(up=wild), Channel(down=wild, up=wild)):
        found = turns(channel, 400)
        seen = [number for turn in found for number in turn.seen]
        taken = [turn.answered for turn in found if turn.answered is not None]
        for numbers in (seen, taken):
            assert numbers == sorted(set(numbers))
        assert len(taken) < 350  # The others were overtaken.
        assert set(taken) <= set(seen)
        assert all(turn.answered is None or turn.answered <= k for k, turn in enumerate(found))


@pytest.mark.parametrize(("loss", "burst"), [(0.1, 1.0), (0.2, 4.0), (0.75, 3.0)])
def test_losses_come_in_the_share_and_the_bursts_that_are_given(loss, burst):
    found = turns(Channel(down=Link(loss=loss, burst=burst)), 40_000)
    lost = np.array([turn.seen == () for turn in found])
    bursts = int((lost[1:] & ~lost[:-1]).sum())
    assert lost.mean() == pytest.approx(loss, rel=0.08)
    assert lost.sum() / bursts == pytest.approx(burst, rel=0.08)


@pytest.mark.parametrize(
    ("jitter", "family"),
    [
        ("gamma", gamma(4.0, scale=0.05)),
        ("lognormal", lognorm(math.sqrt(math.log(1.25)), scale=0.2 / math.sqrt(1.25))),
    ],
)
def test_jitter_is_of_the_family_with_the_given_mean_and_deviation(jitter, family):
    """Of messages sent every second, those in time for the next step: P(delay + jitter < 1 s)."""
    assert (family.mean(), family.std()) == pytest.approx((0.2, 0.1))
    for delay in (0.6, 0.75, 0.85):
        link = Link(delay=delay, jitter=jitter, jitter_mean=0.2, jitter_deviation=0.1)
        found = list(islice(schedule(Channel(down=link), 100, 3), 8000))
        in_time = np.mean([k - 1 in turn.seen for k, turn in enumerate(found)])
        assert in_time == pytest.approx(family.cdf(1.005 - delay), abs=0.02)


def test_the_loss_of_a_message_does_not_depend_on_the_other_numbers():
    def lost(**numbers):
        channel = Channel(down=Link(loss=0.3, burst=2.0, **numbers))
        seen = {number for turn in turns(channel, 300) for number in turn.seen}
        return set(range(250)) - seen

    assert lost() == lost(delay=0.3)
    assert lost() != set()


def test_seeds_differ_and_processes_do_not():
    home = CHANNELS["satellite"]
    assert turns(home, 300, seed=1) != turns(home, 300, seed=2)
    code = (
        "from itertools import islice\n"
        "from colift.benchmark.channels import CHANNELS\n"
        "from colift.benchmark.channels.schedule import schedule\n"
        "print([turn.answered for turn in islice(schedule(CHANNELS['satellite'], 10, 1), 300)])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == str(answered(home, 300))


def test_an_idle_network_costs_nothing_in_a_world_of_frames():
    assert answered(CHANNELS["lan"], 2000) == list(range(2000))
