"""Replays of live lifts: what was lifted, beside two simulated people with the same goals."""

import asyncio
import os
import signal

import pytest
from colift.base.errors import InputError
from colift.benchmark.bundle import read_bundle
from colift.leaderboard.replays.replay import UNIT
from colift.play.web.replaying import Replays, live_replay

from ..rooms.test_room import Table, hand_of


@pytest.fixture(params=["copy", "simulated person", "person"])
def lifted(request, tmp_path):
    """A lift with each kind of partner, in simulated time: the partner, its end, its folder."""
    table = Table(tmp_path / "session", cue_seed=3)
    for seat in (0, 1):
        table.take(table.room.join(seat))
    table.say(0, type="choose", partner=request.param, latency_ms=None, kind="smooth")
    table.prepare()
    for seat in (1, 0):
        table.grip(seat)
    hand = hand_of(table.room._lifting.cue)
    table.lift({0: hand, 1: hand} if request.param == "person" else {0: hand})
    table.room.close()
    end = table.last("end")
    return request.param, end, tmp_path / "session" / end["folder"]


def test_a_replay_shows_the_lift_and_a_team_with_the_same_goals(lifted):
    partner, end, folder = lifted
    cues = read_bundle(folder).recipe.suite().scenarios[0].human.cue.cues()
    replay = live_replay(folder)
    assert replay["policy"] == folder.name.partition("-")[2]
    assert replay["scores"]["rmse_mm"] == pytest.approx(end["rmse_mm"], abs=1e-3)
    assert replay["ghost"]["rmse_mm"] == pytest.approx(end["ghost_rmse_mm"], abs=1e-3)
    assert len(replay["human"]) == replay["horizon"] == len(replay["ghost"]["human"])
    assert bool(replay["command"]) == (partner == "copy")
    # The goals are those that were shown; the plan that only the simulated people had is not.
    assert replay["goals"] == [
        [cue.frame, pytest.approx(cue.height / UNIT, abs=0.51)] for cue in cues
    ]
    assert (replay["target"], replay["events"]) == ([], [])
    assert replay["goal_error_mm"] == pytest.approx(end["goal_error_mm"], abs=1e-3)
    assert replay["ghost"]["team"]
    assert UNIT * sum(replay["human"]) == pytest.approx(0, abs=0.02)  # It was put down.


def test_other_bundles_are_not_taken_for_lifts(tmp_path):
    with pytest.raises(InputError):
        live_replay(tmp_path)


def test_a_process_that_is_killed_is_replaced(tmp_path):
    async def make():
        replays = Replays()
        try:
            for _ in range(2):
                with pytest.raises(InputError):
                    await replays.make(tmp_path)
                (process,) = replays._pool._processes
                os.kill(process, signal.SIGKILL)
            assert not replays.full
        finally:
            replays.close()

    asyncio.run(make())
