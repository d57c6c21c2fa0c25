"""The check of actions behind a channel: the robot holds unless a new answer can have arrived."""

import math
from itertools import islice

import numpy as np
from colift.benchmark.channels import Channel
from colift.benchmark.channels.schedule import channel_seed, schedule
from colift.benchmark.channels.teleoperated import ANSWERED
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.trace import Trace
from colift.benchmark.verification.deviation import Place


def channel_fault(
    channel: Channel | None, scenario: Scenario, seed: int, logged: Trace
) -> Place | None:
    """Return the first step that is impossible behind a channel, or None.

    The channel's delays and losses follow from its numbers and the episode's seed. The log must
    name the answers that then arrive, and the robot must hold its command in every other step.
    """
    if channel is None:
        return None
    if not scenario.seat.is_robot:
        return 0, "a channel leads to a robot, not to a second person"
    steps = len(logged.action)
    turns = schedule(channel, scenario.frames_per_step, channel_seed(scenario, seed))
    answered = [
        math.nan if turn.answered is None else turn.answered for turn in islice(turns, steps)
    ]
    due = np.array(answered, dtype=np.float64)
    told = logged.internals.get(ANSWERED, np.full(steps, math.nan))
    wrong = ~((told == due) | (np.isnan(told) & np.isnan(due)))
    if wrong.any():
        step = int(wrong.argmax())
        return step, (
            f"internals/{ANSWERED} is {told[step]:g}, by the channel it must be {due[step]:g}"
        )
    moves = np.isnan(due) & (logged.action[:, 0].view(np.uint64) != 0)
    if not moves.any():
        return None
    step = int(moves.argmax())
    return step, (
        f"the action is {logged.action[step, 0]:g}, but no new answer has arrived: "
        "the robot holds its command, 0"
    )
