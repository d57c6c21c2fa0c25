"""How well the goals of live lifts were reached: what counts, and what does not."""

import numpy as np
import pytest
from colift.agents.humans import LIVE_SUBJECT, Cued, goal_error_mm, goal_errors, missed_words
from colift.agents.humans.cued import KINDS
from colift.agents.humans.goals import NEAR, SETTLED

SEEDS = range(5)


def plan(cue):
    return np.array(cue.plan(LIVE_SUBJECT, 0).target)


def windows(cue, frames):
    """Return the first frame of each goal, and the one in which the next appears."""
    begins = [each.frame for each in cue.cues()]
    return [*zip(begins, [*begins[1:], frames], strict=True)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_whoever_moves_as_the_cues_ask_reaches_all_goals(kind, seed):
    """Even 0.3 s late: slow hands, and slow connections."""
    cue = Cued(kind=kind, seed=seed)
    target = plan(cue)
    for late in (0, 15, 30):
        errors = goal_errors(cue, np.concatenate((np.zeros(late), target))[: len(target)])
        assert len(errors) == (3 if kind == "pause" else 2)
        assert missed_words(errors) is None
        assert goal_error_mm(errors) < 1.0


@pytest.mark.parametrize("kind", KINDS)
def test_whoever_never_moves_reaches_no_goal_but_rest(kind):
    cue = Cued(kind=kind, seed=1)
    errors = goal_errors(cue, np.zeros(len(plan(cue))))
    assert [each.missed for each in errors] == [True] * (len(errors) - 1) + [False]
    judged = [goal.height for goal in cue.cues()][-len(errors) :]
    assert [each.error for each in errors] == pytest.approx(judged)
    assert missed_words(errors) == (
        f"the {'first ' * (kind == 'pause')}line was not reached and held (the hand was "
        f"{1000 * judged[0]:.0f} mm away; at most 20 mm count)"
    )


def touched_and_left(cue, hand):
    begin, end = windows(cue, len(hand))[-2]
    middle = (begin + end) // 2
    hand[middle : end - 20] = hand[end - 1]
    hand[end - 20 : end] = 0.0


def there_too_early(cue, hand):
    begin, end = windows(cue, len(hand))[-2]
    hand[begin - 80 : begin] = hand[end - 1]
    hand[begin:end] = 0.0


def jumped_at_the_last_moment(cue, hand):
    begin, end = windows(cue, len(hand))[-2]
    hand[begin : end - 15] = 0.0


def too_low(cue, hand):
    begin, end = windows(cue, len(hand))[-2]
    hand[begin:end] -= 0.030


def too_high(cue, hand):
    begin, end = windows(cue, len(hand))[-2]
    hand[begin:end] += 0.030


def shaken(cue, hand):
    """The mean height is the goal's, but the hand is not there."""
    begin, end = windows(cue, len(hand))[-2]
    hand[begin:end] += 0.030 * np.sign(np.sin(np.arange(end - begin)))


def not_put_down(cue, hand):
    begin, _ = windows(cue, len(hand))[-1]
    hand[begin:] = 0.05


def put_down_and_lifted_again(cue, hand):
    hand[-30:] = 0.10


CHEATS = [
    touched_and_left,
    there_too_early,
    jumped_at_the_last_moment,
    too_low,
    too_high,
    shaken,
    not_put_down,
    put_down_and_lifted_again,
]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("cheat", CHEATS)
def test_a_goal_that_was_not_reached_and_held_is_missed(cheat, kind):
    cue = Cued(kind=kind, seed=2)
    hand = plan(cue)
    cheat(cue, hand)
    errors = goal_errors(cue, hand)
    rest = cheat in (not_put_down, put_down_and_lifted_again)
    assert [each.missed for each in errors[-2:]] == [not rest, rest]
    assert ("the height of rest" in missed_words(errors)) == rest


def test_a_goal_that_is_replaced_on_the_way_need_not_be_reached():
    cue = Cued(kind="changing_goal", seed=3)
    hand = plan(cue)
    first, second, _ = cue.cues()
    hand[first.frame : second.frame] = 0.0
    assert missed_words(goal_errors(cue, hand)) is None


@pytest.mark.parametrize("off", [0.9 * NEAR, 1.1 * NEAR])
def test_the_error_is_the_mean_distance_when_the_hand_must_be_there(off):
    cue = Cued(kind="smooth", seed=4)
    hand = plan(cue)
    _, end = windows(cue, len(hand))[0]
    hand[end - round(100 * SETTLED) : end] = cue.cues()[0].height + off
    line, rest = goal_errors(cue, hand)
    assert line.error == pytest.approx(off)
    assert line.missed == (off > NEAR)
    assert goal_error_mm((line, rest)) == pytest.approx(1000 * (line.error + rest.error) / 2)
