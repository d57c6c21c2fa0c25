"""Sessions: one policy object, lifts in order, equal bits however they are played."""

import dataclasses

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.admission.remembering import check_people
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.execution.batches import Batch, batches, shuffled_batches
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.paper.practice import Practising
from colift.benchmark.results.baselines import HUMAN_HUMAN, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.hidden import hidden_suite
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.verification import verify
from colift.benchmark.verification.audit import audit

WHOLE = make_suite("session-v1")
SUITE = dataclasses.replace(WHOLE, name="few", scenarios=WHOLE.scenarios[:3])
RECALL = PolicySpec(text="recall")

POLICY = """
import numpy as np

class Counting:
    '''Lowers its hand by as many micrometres as it has begun lifts and sessions.'''
    def begin_session(self):
        self.sessions = getattr(self, "sessions", 0) + 1
        self.lifts = 0
    def reset(self, seed):
        self.lifts += 1
    def act(self, observation):
        return np.array([-1e-6 * (self.lifts + 100 * self.sessions)])

class Failing(Counting):
    def act(self, observation):
        if self.lifts == 3:
            raise ValueError("the third lift")
        return super().act(observation)

class Sly(Counting):
    '''Keeps a count beyond its session.'''
    def reset(self, seed):
        np.sly = getattr(np, "sly", 0) + 1
        self.lifts = np.sly
"""


@pytest.fixture(scope="module")
def run():
    return run_suite(RECALL, SUITE)


@pytest.fixture
def policies(tmp_path):
    (tmp_path / "policies.py").write_text(POLICY)
    return tmp_path / "policies.py"


def digests(run):
    return [each.trace.digest() for each in run.episodes]


def first_actions(run):
    return [round(-1e6 * float(each.trace.action[:1].sum())) for each in run.episodes]


def test_a_session_is_a_unit_of_work_and_lifts_are_in_order():
    assert (WHOLE.session, make_suite("standard-v1").session) == (10, 0)
    for made in (batches(RECALL, SUITE), shuffled_batches(RECALL, SUITE, bytes(32))):
        for batch in made:
            places = [due.place for due in batch.lifts]
            assert places == list(range(places[0], places[0] + 10))
            assert places[0] % 10 == 0
            assert [due.scenario.human.place for due in batch.lifts] == list(range(10))
            assert len({due.scenario.name for due in batch.lifts}) == 1


def test_one_object_plays_a_session_and_another_the_next(policies):
    found = first_actions(run_suite(PolicySpec(text=f"{policies}:Counting"), SUITE))
    assert found == 3 * [100 + lift for lift in range(1, 11)]


def test_a_policy_that_fails_begins_again_in_the_next_lift(policies):
    run = run_suite(PolicySpec(text=f"{policies}:Failing"), SUITE)
    failed = [each.failure for each in run.episodes[:10]]
    assert [i for i, each in enumerate(failed) if each] == [2, 5, 8]
    assert failed[2] == "step 0: ValueError: the third lift"
    assert first_actions(run)[3:5] == [101, 102]


@pytest.mark.slow
def test_the_result_is_the_same_on_workers_in_another_order_and_resumed(run):
    with process_pool(2) as pool:
        assert digests(run_suite(RECALL, SUITE, executor=pool)) == digests(run)
    assert digests(run_suite(RECALL, SUITE, secret=bytes(32))) == digests(run)
    done = {place: run.episodes[place] for place in (0, 1, 2, 3, 14, 20, 29)}
    played = []
    again = run_suite(RECALL, SUITE, done=done, keep=lambda place, _: played.append(place))
    assert digests(again) == digests(run)
    assert {*played} == {*range(30)} - {*done}


def test_a_person_remembers_and_another_session_does_not(run):
    alone = dataclasses.replace(SUITE, scenarios=SUITE.scenarios[1:2])
    assert digests(run_suite(RECALL, alone)) == digests(run)[10:20]
    due = SUITE.at(9)
    (stranger,) = Batch(policy=RECALL, lifts=(due,))()
    assert stranger[1].trace.digest() != digests(run)[9]


def test_the_last_lifts_count_and_all_are_shown(run):
    table = ScoreTable.of(run)
    rmse = [each.scores["rmse_mm"] for each in run.episodes]
    assert list(table.lifts_mm) == rmse
    counted = [rmse[i] for i in range(30) if i % 10 >= 7]
    assert list(table.rmse_mm) == counted
    assert table.mean == pytest.approx(np.mean(counted))
    assert table.units.count == 3
    assert ScoreTable.read(table.stored().plain()) == table.stored()


@pytest.mark.slow
def test_a_bundle_is_verified_in_order_and_an_exchanged_lift_is_found(run, tmp_path):
    people = ScoreTable.of(human_human_run(SUITE))
    content = results(run, {HUMAN_HUMAN: people})
    write_bundle(tmp_path / "one", run, content.plain(), human_human=people)
    verdict = verify(tmp_path / "one")
    assert verdict.ok, verdict.findings
    assert verdict.bit_equal
    # The same person, seeds and actions, but a partner who was another in the lifts before.
    other = run_suite(PolicySpec(text="copy"), SUITE)
    episodes = (*other.episodes[:5], *run.episodes[5:])
    mixed = dataclasses.replace(run, episodes=episodes)
    write_bundle(tmp_path / "two", mixed, results(mixed, {}).plain(), human_human=None)
    found = verify(tmp_path / "two").findings
    assert found
    assert found[0].episode == "habitual/draw-601 seed 5"


@pytest.mark.slow
def test_what_is_kept_beyond_a_session_is_found_by_the_audit(policies):
    sly = PolicySpec(text=f"{policies}:Sly")
    run = run_suite(sly, SUITE)
    assert audit(sly, run, bytes(32)) is not None
    del np.sly
    assert audit(RECALL, run_suite(RECALL, SUITE), bytes(32)) is None


def test_hidden_sessions_have_other_people_and_the_same_order():
    hidden = hidden_suite(SUITE, bytes(32))
    assert hidden.session == 10
    assert {each.subject.name for each in hidden.scenarios}.isdisjoint(
        each.subject.name for each in SUITE.scenarios
    )


def test_sessions_and_independent_lifts_are_not_mixed():
    other = make_suite("quick-v1").scenarios[:1]
    with pytest.raises(InputError, match="has sessions and independent lifts"):
        Suite(name="mixed", scenarios=(*SUITE.scenarios, *other), seeds=(0, 1))


def test_only_people_with_habits_can_be_tested_for_memory():
    check_people(SUITE)
    practising = dataclasses.replace(SUITE.scenarios[0], behaviour="practising", human=Practising())
    with pytest.raises(InputError, match=r"few: only sessions .* can be tested, got practising"):
        check_people(dataclasses.replace(SUITE, scenarios=(practising,)))
