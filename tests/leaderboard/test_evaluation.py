"""An evaluation: a function of the submission and the season's secret, and of nothing else."""

import dataclasses
import itertools
import json

import numpy as np
import pytest
from colift.agents.errors import EvaluatorFault
from colift.agents.policies.in_process import InProcess
from colift.agents.policies.loading import PolicySpec
from colift.benchmark.audit import CHANCE
from colift.benchmark.bundle import read_bundle
from colift.benchmark.episode import policy_seed
from colift.benchmark.hidden import commitment
from colift.benchmark.runner import run_suite
from colift.leaderboard.evaluation import Watch, amount, evaluate, play_team
from colift.leaderboard.row import Row

from .conftest import make_entrant, make_season

counter = itertools.count()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Trying(InProcess):
    """Follows the human's end; ``hidden`` is called in each step of a hidden episode."""

    hidden: object
    name: str = "trying"

    def check(self):
        pass

    def digest(self):
        return "0"

    def make(self):
        return Tried(self.hidden)


class Tried:
    def __init__(self, hidden):
        self.hidden = hidden

    def reset(self, seed):
        self.public = seed == policy_seed()

    def act(self, observation):
        change = 0.0 if self.public else self.hidden(observation)
        return np.array([observation[0] - observation[3] + change])


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    return tmp_path_factory.mktemp("evaluation") / "bundle"


@pytest.fixture(scope="module")
def evaluation(season, team, told, bundle):
    watch = Watch(stage=told.append, progress=told.append)
    return evaluate(make_entrant(PolicySpec(text="copy")), season, team, bundle, watch=watch)


def without_times(row):
    public = dataclasses.replace(row.public, step_ms_p50=None, step_ms_p99=None)
    return dataclasses.replace(row, public=public)


def test_a_row_has_the_scores_of_both_runs(evaluation, season, team):
    row = evaluation.row
    public = run_suite(PolicySpec(text="copy"), season.suite)
    hidden = run_suite(PolicySpec(text="copy"), season.hidden, key=season.policy_key)
    errors = [[e.scores.rmse_mm for e in run.episodes] for run in (public, hidden)]
    assert row.public.rmse_mm.mean == pytest.approx(np.mean(errors[0]))
    assert row.hidden.rmse_mm.mean == round(np.mean(errors[1]), 2)
    assert row.hidden.vs_human.mean == round(np.mean(errors[1]) / team.mean, 2)
    assert row.gap_mm.mean == round(np.mean(errors[1]) - np.mean(errors[0]), 2)
    assert list(evaluation.hidden_rmse_mm) == errors[1]
    for each in (row.public.rmse_mm, row.hidden.rmse_mm, row.hidden.vs_human, row.gap_mm):
        assert each.ci95[0] < each.mean < each.ci95[1]
    assert (row.public.episodes, row.hidden.episodes) == (12, 12)
    assert (row.commitment, row.suite_digest) == (commitment(season.secret), season.suite.digest)


def test_stages_and_progress_are_told(evaluation, season, told):
    stages = ["public run", "audit", "hidden run", "audit", "verification"]
    assert [each for each in told if isinstance(each, str)] == stages
    assert sum(each for each in told if isinstance(each, int)) == amount(season)


def test_the_same_secret_gives_the_same_row(evaluation, season, team, copy, tmp_path):
    again = evaluate(copy, season, team, tmp_path / "again")
    assert without_times(again.row) == without_times(evaluation.row)
    assert again.hidden_rmse_mm == evaluation.hidden_rmse_mm


def test_another_secret_gives_other_hidden_scores(evaluation, copy, tmp_path):
    other = make_season(bytes(range(1, 33)))
    row = evaluate(copy, other, play_team(other), tmp_path / "other").row
    assert row.hidden.rmse_mm != evaluation.row.hidden.rmse_mm
    assert row.public.rmse_mm == evaluation.row.public.rmse_mm


def test_the_bundle_is_that_of_the_public_run(evaluation, bundle, season):
    content = read_bundle(bundle)
    assert content.run().suite.digest == season.suite.digest
    assert content.results["summary"]["rmse_mm"]["mean"] == evaluation.row.public.rmse_mm.mean


def test_a_policy_in_this_process_is_never_verified(evaluation):
    assert (evaluation.row.isolation, evaluation.row.verified) == ("none", False)


def test_a_row_is_read_as_it_was_written(evaluation):
    row = evaluation.row
    assert Row.read(json.loads(json.dumps(row.plain()))) == row


def test_a_policy_that_acts_by_chance_in_public_is_refused_with_the_place(season, team, tmp_path):
    text = f"{tmp_path / 'chance.py'}:Chance"
    (tmp_path / "chance.py").write_text(
        "import os\n"
        "class Chance:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return [os.urandom(1)[0] * 1e-6]\n"
    )
    found = evaluate(make_entrant(PolicySpec(text=text)), season, team, tmp_path / "bundle")
    assert found.row is None
    assert CHANCE in found.refusal
    assert "seed" in found.refusal
    assert found.hidden_rmse_mm == ()


def test_a_policy_that_does_so_in_hidden_episodes_is_refused_without_the_place(
    season, team, tmp_path
):
    policy = Trying(hidden=lambda observation: 1e-6 * next(counter))
    found = evaluate(make_entrant(policy), season, team, tmp_path / "bundle")
    assert found.row is None
    assert found.refusal == f"played again, a hidden episode differs: {CHANCE}"


def test_failed_hidden_episodes_count_as_worst_and_are_told_in_no_words_of_the_policy(
    season, team, tmp_path
):
    def shout(observation):
        raise RuntimeError(f"start: MARK {observation}")

    found = evaluate(make_entrant(Trying(hidden=shout)), season, team, tmp_path / "bundle")
    row = found.row
    assert (row.public.failed, row.hidden.failed) == (0, 12)
    assert row.hidden.failures == {"step": 12}
    assert row.hidden.rmse_mm.mean == 250.0
    assert "MARK" not in json.dumps(row.plain())
    for path in (tmp_path / "bundle").iterdir():
        assert b"MARK" not in path.read_bytes()


def test_all_that_is_told_of_hidden_episodes_is_this(evaluation):
    hidden = evaluation.row.plain()["hidden"]
    assert set(hidden) == {
        "episodes", "failed", "failures", "rmse_mm", "vs_human", "better_than_human"
    }  # fmt: skip
    for estimate in (hidden["rmse_mm"], hidden["vs_human"], evaluation.row.plain()["gap_mm"]):
        for value in (estimate["mean"], *estimate["ci95"]):
            assert value == round(value, 2)


def test_a_machine_that_fails_is_no_failure_of_the_submission(season, team, tmp_path):
    def break_down(observation):
        raise EvaluatorFault("the disk is full")

    with pytest.raises(EvaluatorFault, match="the disk is full"):
        evaluate(make_entrant(Trying(hidden=break_down)), season, team, tmp_path / "bundle")


def test_an_interrupted_evaluation_gives_no_row(season, team, copy, tmp_path):
    def interrupt(episodes):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        evaluate(copy, season, team, tmp_path / "bundle", watch=Watch(progress=interrupt))
