"""Plans with hurdles, what people infer of each other, and whose turn it is."""

import numpy as np
import pytest
from colift.agents.agent import FRAME, HumanObservation
from colift.agents.humans import SUBJECTS, Subject
from colift.agents.rules import SCALARS
from colift.agents.tasks.agree.belief import (
    BeliefParameters,
    GoalBelief,
    Motion,
    believe,
    own_goal,
    prior,
)
from colift.benchmark.tasks.agree.hurdles import (
    APART,
    AWAY,
    LENGTH,
    Abreast,
    Ahead,
    Behind,
    NoHurdle,
    OtherHurdle,
    OwnHurdle,
)
from colift.benchmark.tasks.agree.manner import MANNERS, AgreeingManner, agreeing_manner
from colift.benchmark.tasks.agree.person import Negotiates
from colift.benchmark.tasks.agree.person import Sight as Seeing
from colift.benchmark.tasks.agree.precedence import (
    EARLY,
    NEEDED,
    SERVED,
    Obstacle,
    Secret,
    Sight,
    Turn,
    mine,
    served,
)
from colift.benchmark.tasks.agree.second import SecondNegotiator, with_secret
from colift.benchmark.tasks.agree.task import Facts
from colift.testing import check_behaviour

from ..past import Past, Walking, drawn_of

S1 = SUBJECTS["S1"]
ALL = (Abreast, Ahead, Behind, OwnHurdle, OtherHurdle, NoHurdle)


@pytest.mark.parametrize("behaviour", ALL)
def test_plans_conform(behaviour):
    check_behaviour(behaviour())


@pytest.mark.parametrize("behaviour", ALL)
def test_who_has_a_hurdle_follows_from_the_behaviour(behaviour):
    for seed in range(10):
        plan = behaviour().plan(S1, seed)
        assert (plan.own is not None, plan.other is not None) == behaviour.has


def test_hurdles_are_away_from_the_common_height_and_from_each_other():
    for seed in range(100):
        plan = Abreast().plan(S1, seed)
        ways = [abs(hurdle.height - plan.goal) for hurdle in (plan.own, plan.other)]
        assert AWAY[0] <= min(ways) <= max(ways) <= AWAY[1]
        assert APART[0] <= abs(plan.own.height - plan.other.height) <= APART[1]
        first, last = plan.agreeing
        for hurdle in (plan.own, plan.other):
            assert first < hurdle.start < hurdle.stop < last
            length = (hurdle.stop - hurdle.start) * FRAME
            assert LENGTH[0] - FRAME <= length <= LENGTH[1] + FRAME
        assert np.ptp(plan.target[first:last]) < 1e-9


@pytest.mark.parametrize(("behaviour", "low", "high"), [(Ahead, 20, 40), (Behind, -40, -20)])
def test_ahead_and_behind_say_whose_window_opens_first(behaviour, low, high):
    for seed in range(30):
        plan = behaviour().plan(S1, seed)
        assert low - 1 <= plan.other.start - plan.own.start <= high + 1


def moved(goal, steps=4, start=0.15, mine=0.15, pace=5.0):
    """Return a belief after a partner has gone to a goal, or along with me."""
    belief, height = GoalBelief(), start
    for _ in range(steps):
        after = height + (1 - np.exp(-0.1 * pace)) * (goal - height)
        belief.update(height, after, mine, 0.15, 0.1)
        height = after
    return belief


def test_a_partner_who_goes_away_is_believed_to_have_a_goal_there():
    for offset in (-0.05, -0.03, 0.03, 0.05):
        belief = moved(0.15 + offset)
        assert belief.own_goal > 0.9
        assert belief.offset == pytest.approx(offset, abs=0.015)


def test_a_partner_who_rests_or_comes_along_has_no_goal():
    assert moved(0.15).own_goal < 0.1
    assert moved(0.19, mine=0.19).own_goal < 0.5
    assert abs(moved(0.15).offset) < 0.003


def test_a_belief_is_slower_the_less_is_known():
    parameters, found = BeliefParameters(), []
    nothing = prior(SCALARS, parameters, 0.0)
    for noise in (0.0, 0.2):
        seen = Motion(before=0.15, after=0.165, mine=0.15, common=0.15, noise=noise)
        found.append(own_goal(believe(SCALARS, parameters, nothing, seen, 0.1)))
    assert found[0] > found[1]
    assert own_goal(nothing) < 0.2


class Deciding:
    """A person at a hurdle of 200 mm, who decides every 0.1 s."""

    def __init__(self, patience, insistence):
        self.manner = AgreeingManner(
            patience=patience, trust=1.0, stiffness=1.0, insistence=insistence
        )
        self.turn = Turn(0.0, 0.0, 0.0, False, False, False, False)

    def mine(self, start, stop, *, apart, own=0.15, far=0.15):
        """Return whether it is the person's turn."""
        seen, hurdle = Sight(own, far, 0.15, 0.0), Secret(0.2, start, stop, 1.0)
        self.turn, goes = mine(SCALARS, self.manner, self.turn, hurdle, seen, apart, 0.1)
        return goes


def first_turn(deciding, *, apart=False, length=1.5):
    """Return when the turn comes [s] after the opening of a window, None if never."""
    for k in range(-10, round(10 * length)):
        if deciding.mine(-0.1 * k, length - 0.1 * k, apart=apart):
            return 0.1 * k
    return None


def test_the_eager_begin_as_the_window_opens_and_the_patient_at_the_last_moment():
    assert first_turn(Deciding(0.0, 1.0)) == pytest.approx(-EARLY, abs=0.1)
    assert first_turn(Deciding(1.0, 1.0)) == pytest.approx(1.5 - NEEDED, abs=0.1)


def test_a_partner_on_the_way_is_let_go_first_until_it_is_too_late():
    assert first_turn(Deciding(0.0, 1.0), apart=True) == pytest.approx(1.5 - NEEDED, abs=0.1)


def test_the_stubborn_let_nobody_go_first():
    assert first_turn(Deciding(0.0, 1.1), apart=True) == pytest.approx(-EARLY, abs=0.1)


def test_the_eager_set_out_before_their_window_opens():
    latest = 1.5 - NEEDED
    early = -EARLY - 0.5 * (latest + EARLY)
    assert first_turn(Deciding(-0.5, 1.0)) == pytest.approx(early, abs=0.1)


def test_in_a_conflict_a_person_gives_way_after_a_while_and_resumes_when_the_partner_is_done():
    deciding = Deciding(0.0, 0.35)
    assert deciding.mine(0.0, 1.5, apart=False)
    insisted = [deciding.mine(0.0, 1.4, apart=True) for _ in range(6)]
    assert insisted == [True, True, True, False, False, False]
    there = Sight(own=0.188, far=0.19, common=0.15, speed=0.01)
    for _ in range(round(SERVED / 0.1) + 1):
        deciding.turn = served(SCALARS, deciding.turn, there, 0.1)
    assert deciding.mine(-0.8, 0.7, apart=True)


def test_a_hurdle_is_passed_by_both_ends_that_stay_there_in_its_window():
    deciding = Deciding(0.0, 1.0)
    for _ in range(5):
        deciding.mine(0.1, 1.0, apart=False, own=0.2, far=0.2)
        deciding.mine(-0.1, 1.0, apart=False, own=0.2, far=0.17)
    for far in (0.195, 0.205, 0.17, 0.2, 0.2):
        assert deciding.mine(-0.1, 1.0, apart=False, own=0.201, far=far)
    assert not deciding.turn.passed
    assert not deciding.mine(-0.1, 1.0, apart=False, own=0.201, far=0.195)
    assert deciding.turn.passed


def played(person, secret, far, steps, common=0.15, frames=10):
    """Return a person's references at the common height, after 2 s to settle there.

    ``far`` returns the far end's height, of the person's own heights and the time.
    """
    person.reset(3)
    settling = 20 * 10 // frames
    references, own = [], [common] * 40
    for step in range(settling + steps):
        time = (step - settling) * frames * FRAME
        view = np.zeros(HumanObservation.size(frames))
        view[HumanObservation.OWN_HEIGHT] = own[-10:]
        view[HumanObservation.OTHER_END] = far(own, time)
        view[HumanObservation.TARGET] = common
        now = secret._replace(start=secret.start - time, stop=secret.stop - time)
        action = person.act(with_secret(view, now, 0.0)).tolist()
        references += action
        own += action
    return np.array(references[settling * frames :])


def rests(own, time):
    return 0.15


def walked(subject, hurdle, far, steps):
    """Return a person's references at the common height, after 2 s to settle there."""
    start, frames = 200, 200 + 10 * steps
    nothing = Obstacle(0.0, 0.0, 0.0, 0.0)
    own = hurdle._replace(start=hurdle.start + start, stop=hurdle.stop + start)
    drawn = drawn_of(
        np.full(frames, 0.15),
        agreeing_manner(subject),
        facts=Facts(own, nothing, frames, 0.0),
        chance=Seeing(np.zeros(frames)),
    )
    view = Past(visual=round(subject.visual_delay / FRAME))
    view.read = {"human_end": [0.15] * 40, "robot_end": [0.15] * 40}
    walking, references = Walking(Negotiates(), drawn), []
    while view.frame < frames:
        first = view.frame - start
        found = walking.step(view)
        references += found
        view.read["human_end"] += found
        view.read["robot_end"] += [
            far(view.read["human_end"], (first + i) * FRAME) for i in range(len(found))
        ]
    return np.array(references[start:])


def test_a_person_passes_the_own_hurdle_when_the_far_end_comes_along():
    path = walked(S1, Obstacle(0.19, 50.0, 200.0, 1.0), lambda own, time: own[-20], 25)
    assert path[50:200].max() == pytest.approx(0.19, abs=0.008)
    assert path[:20] == pytest.approx(0.15, abs=0.01)


def test_a_trusting_person_without_a_hurdle_goes_where_the_far_end_goes():
    def leading(own, time):
        return 0.15 + 0.04 * min(max((time - 0.3) / 0.4, 0.0), 1.0)

    path = walked(SUBJECTS["S2"], Obstacle(0.0, 0.0, 0.0, 0.0), leading, 20)
    assert path[:30] == pytest.approx(0.15, abs=0.01)
    assert path[80:120].mean() > 0.17


def test_a_second_human_goes_to_its_hurdle_from_the_common_height():
    path = played(SecondNegotiator(), Secret(0.11, 0.6, 2.1, 1.0), rests, 22)
    assert path[:30] == pytest.approx(0.15, abs=0.01)
    assert path[100:200].min() == pytest.approx(0.11, abs=0.012)


@pytest.mark.parametrize("frames", [1, 4, 25])
def test_any_length_of_a_step_can_be_played(frames):
    path = played(
        SecondNegotiator(), Secret(0.11, 0.6, 2.1, 1.0), rests, 200 // frames, frames=frames
    )
    assert path[100:].min() == pytest.approx(0.11, abs=0.015)


def test_manners_follow_from_the_name_alone_and_new_people_differ():
    drawn = [agreeing_manner(Subject.draw(seed)) for seed in range(20)]
    assert len({manner.patience for manner in drawn}) == 20
    assert drawn[3] == agreeing_manner(Subject.draw(3))
    assert agreeing_manner(S1) == MANNERS["S1"]
