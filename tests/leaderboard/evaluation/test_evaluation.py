"""An evaluation: a function of the submission and the season's secret, and of nothing else."""

import dataclasses
import itertools
import json
import time

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import InProcess
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.bundle import read_bundle
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.execution.playing import play
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import play_baselines
from colift.benchmark.suites.hidden import commitment
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.audit import RULE
from colift.leaderboard.evaluation.evaluate import (
    episode_count,
    evaluate_entrant,
    play_human_human,
)
from colift.leaderboard.evaluation.progress import HIDDEN, Budget, BudgetError, Callbacks
from colift.leaderboard.records.row import BoardRow

from ..conftest import make_entrant, make_season

pytestmark = pytest.mark.slow

counter = itertools.count()


@dataclasses.dataclass(frozen=True, kw_only=True)
class Trying(InProcess):
    """Follows the human's end; ``hidden`` is called in each step of a hidden episode.

    It knows by the stages that the evaluation tells: its seed and its lifts do not give it away.
    """

    hidden: object
    stages: list = dataclasses.field(default_factory=list)
    name: str = "trying"

    def check(self):
        pass

    def digest(self):
        return "0"

    def make(self):
        return Tried(self)


class Tried:
    def __init__(self, trying):
        self.trying = trying

    def reset(self, seed):
        assert seed == policy_seed()

    def act(self, observation):
        change = self.trying.hidden(observation) if self.trying.stages[-1] == HIDDEN else 0.0
        return np.array([observation[0] - observation[3] + change])


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    return tmp_path_factory.mktemp("evaluation") / "bundle"


@pytest.fixture(scope="module")
def evaluation(season, human_human, told, bundle):
    watch = Callbacks(stage=told.append, progress=told.append)
    return evaluate_entrant(
        make_entrant(PolicySpec(text="copy")), season, human_human, bundle, watch=watch
    )


def evaluated(policy, season, human_human, bundle):
    """Evaluate a policy that is told the stages."""
    watch = Callbacks(stage=policy.stages.append)
    return evaluate_entrant(make_entrant(policy), season, human_human, bundle, watch=watch)


def without_times(row):
    public = dataclasses.replace(row.public, step_ms_p50=None, step_ms_p99=None)
    return dataclasses.replace(row, public=public)


def test_a_row_has_the_scores_of_both_runs(evaluation, season, human_human):
    row = evaluation.row
    public = run_suite(PolicySpec(text="copy"), season.suite)
    hidden = run_suite(PolicySpec(text="copy"), season.hidden)
    errors = [[e.scores["rmse_mm"] for e in run.episodes] for run in (public, hidden)]
    assert row.public.rmse_mm.mean == pytest.approx(np.mean(errors[0]))
    assert row.hidden.rmse_mm.mean == round(np.mean(errors[1]), 2)
    two = play_baselines(season.suite)["human_human"].rmse_mm, human_human.rmse_mm
    logs = [np.log(np.divide(*each)).mean() for each in zip(errors, two, strict=True)]
    assert row.hidden.vs_human.mean == round(np.exp(logs[1]), 2)
    assert row.gap.mean == round(np.exp(logs[1] - logs[0]), 2)
    assert list(evaluation.hidden_rmse_mm) == errors[1]
    for each in (row.public.rmse_mm, row.hidden.rmse_mm, row.hidden.vs_human, row.gap):
        assert each.ci95 is None, "all lifts are of one person"
    assert (row.public.episodes, row.hidden.episodes) == (2, 2)
    assert (row.commitment, row.suite_digest) == (commitment(season.secret), season.suite.digest)


def test_stages_and_progress_are_told(evaluation, season, told):
    stages = ["check", "public run", "audit", "verification", "hidden run"]
    assert [each for each in told if isinstance(each, str)] == stages
    assert sum(each for each in told if isinstance(each, int)) == episode_count(season)


def test_the_same_secret_gives_the_same_row(evaluation, season, human_human, copy, tmp_path):
    again = evaluate_entrant(copy, season, human_human, tmp_path / "again")
    assert without_times(again.row) == without_times(evaluation.row)
    assert again.hidden_rmse_mm == evaluation.hidden_rmse_mm


def test_another_secret_gives_other_hidden_scores(evaluation, copy, tmp_path):
    other = make_season(bytes(range(1, 33)))
    row = evaluate_entrant(copy, other, play_human_human(other), tmp_path / "other").row
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
    assert BoardRow.read(json.loads(json.dumps(row.plain()))) == row


def written(folder, act, imports="import os"):
    """Return a policy of a file with that method ``act``."""
    (folder / "written.py").write_text(
        f"{imports}\n"
        "class Written:\n"
        "    def reset(self, seed): self.step = -1\n"
        "    def act(self, observation):\n"
        "        self.step += 1\n"
        f"        {act}\n"
    )
    return PolicySpec(text=f"{folder / 'written.py'}:Written")


@pytest.mark.parametrize(
    ("act", "reason"),
    [
        ("raise ValueError('my fault')", "lifts failed: smooth/S1 seed 7000: step 0: ValueError"),
        ("return [os.urandom(1)[0] * 1e-6]", "determinism failed: played again"),
        ("return 'up'", "lifts failed: smooth/S1 seed 7000: step 0: robot's action must be"),
    ],
)
def test_what_fails_the_check_is_played_no_further(season, human_human, tmp_path, act, reason):
    stages = []
    with pytest.raises(InputError, match=f"the check of its {reason}"):
        evaluate_entrant(
            make_entrant(written(tmp_path, act)),
            season,
            human_human,
            tmp_path / "bundle",
            watch=Callbacks(stage=stages.append),
        )
    assert stages == ["check"]
    assert not (tmp_path / "bundle").exists()


def test_what_fails_in_every_public_lift_gets_no_row(season, human_human, tmp_path, monkeypatch):
    """It passes the check: as if that were on other lifts."""
    monkeypatch.setattr(
        "colift.leaderboard.evaluation.evaluate.presubmission_checks", lambda *_: ()
    )
    policy = written(tmp_path, "raise ValueError('my fault')")
    told = r"in every public lift: 2 lifts: ValueError: my fault \(first: smooth/draw-1 seed 0"
    with pytest.raises(InputError, match=told):
        evaluate_entrant(make_entrant(policy), season, human_human, tmp_path / "bundle")


def test_the_time_of_all_lifts_together_is_bounded(season, human_human, tmp_path):
    """A step takes 2 ms here, a lift some 80 steps: the check alone takes longer."""
    stages = []
    policy = written(tmp_path, "time.sleep(0.002); return [0.0]", "import time")
    with pytest.raises(BudgetError, match=r"the policy took more than 0\.5 s for all lifts"):
        evaluate_entrant(
            make_entrant(policy),
            season,
            human_human,
            tmp_path / "bundle",
            watch=Callbacks(stage=stages.append),
            budget=Budget(0.5),
        )
    assert HIDDEN not in stages


def test_time_that_a_policy_takes_to_begin_and_to_fail_is_counted(season):
    """Not only the steps: to import, and to hang until a limit ends it, takes time as well."""

    class Late(InProcess):
        name = "late"

        def make(self):
            time.sleep(0.05)
            return self

        def reset(self, seed):
            time.sleep(0.05)

        def act(self, observation):
            time.sleep(0.05)
            raise ValueError

    (episode,) = play(Late(), season.suite.scenarios[0], (0,))
    assert episode.step_times == ()
    assert episode.policy_time >= 0.15


def test_a_policy_that_acts_by_chance_in_public_is_refused_with_the_place(
    season, human_human, tmp_path, monkeypatch
):
    monkeypatch.setattr(
        "colift.leaderboard.evaluation.evaluate.presubmission_checks", lambda *_: ()
    )
    policy = written(tmp_path, "return [os.urandom(1)[0] * 1e-6]")
    found = evaluate_entrant(make_entrant(policy), season, human_human, tmp_path / "bundle")
    assert found.row is None
    assert RULE in found.refusal
    assert "seed" in found.refusal
    assert found.hidden_rmse_mm == ()


def test_a_policy_that_does_so_in_hidden_episodes_is_refused_without_the_place(
    season, human_human, tmp_path
):
    policy = Trying(hidden=lambda observation: 1e-6 * next(counter))
    found = evaluated(policy, season, human_human, tmp_path / "bundle")
    assert found.row is None
    assert found.refusal == f"played again, a hidden episode differs: {RULE}"


def test_failed_hidden_episodes_count_as_worst_and_are_told_in_no_words_of_the_policy(
    season, human_human, tmp_path
):
    def shout(observation):
        raise RuntimeError(f"start: MARK {observation}")

    found = evaluated(Trying(hidden=shout), season, human_human, tmp_path / "bundle")
    row = found.row
    assert (row.public.failed, row.hidden.failed) == (0, 2)
    assert row.hidden.failures == {"step": 2}
    assert row.hidden.rmse_mm.mean == 250.0
    assert "MARK" not in json.dumps(row.plain())
    for path in (tmp_path / "bundle").iterdir():
        assert b"MARK" not in path.read_bytes()


def test_all_that_is_told_of_hidden_episodes_is_this(evaluation):
    hidden = evaluation.row.plain()["hidden"]
    assert set(hidden) == {
        "episodes", "failed", "failures", "rmse_mm", "vs_human", "better_than_human", "rougher",
        "real_time",
    }  # fmt: skip
    for estimate in (hidden["rmse_mm"], hidden["vs_human"], evaluation.row.plain()["gap"]):
        for value in (estimate["mean"], *(estimate["ci95"] or ())):
            assert value == round(value, 2)


def test_a_machine_that_fails_is_no_failure_of_the_submission(season, human_human, tmp_path):
    def break_down(observation):
        raise EvaluatorFault("the disk is full")

    with pytest.raises(EvaluatorFault, match="the disk is full"):
        evaluated(Trying(hidden=break_down), season, human_human, tmp_path / "bundle")


def test_an_interrupted_evaluation_gives_no_row(season, human_human, copy, tmp_path):
    def interrupt(episodes):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        evaluate_entrant(
            copy, season, human_human, tmp_path / "bundle", watch=Callbacks(progress=interrupt)
        )


def test_sessions_are_ranked_by_the_lifts_that_count(tmp_path):
    whole = make_suite("session-v1")
    suite = dataclasses.replace(whole, name="few", scenarios=whole.scenarios[:2])
    season = dataclasses.replace(make_season(), suite=suite)
    people, told = play_human_human(season), []
    found = evaluate_entrant(
        make_entrant(PolicySpec(text="recall")),
        season,
        people,
        tmp_path / "bundle",
        watch=Callbacks(progress=told.append),
    )
    assert found.refusal is None
    assert sum(told) == episode_count(season)
    assert len(found.hidden_rmse_mm) == len(people.units.unit) == 2 * 3
    assert found.row.hidden.rmse_mm.mean == round(np.mean(found.hidden_rmse_mm), 2)
    assert len(read_bundle(tmp_path / "bundle").episodes) == 20
