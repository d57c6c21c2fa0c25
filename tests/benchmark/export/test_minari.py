"""Minari data sets: they open in Minari, and replay in the engine, bit for bit."""

import dataclasses
import json
from contextlib import closing

import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.base.errors import InputError
from colift.benchmark.environment.parallel import ParallelLift, parallel_env
from colift.benchmark.export.exporting import CardWords, export
from colift.benchmark.export.fixed_sets import play_set, set_plan
from colift.benchmark.export.observing import spaces
from colift.benchmark.export.proving import proved_lifts

from .conftest import LIFTS, SUITE

minari = pytest.importorskip("minari")
WORDS = CardWords(about="Four lifts.", people="simulated", shows=("Little.",), licence="MIT")


@pytest.fixture
def written(bundle, boxes, provenance, tmp_path):
    """Return what exports the bundle, and reads it again."""

    def made(view="robot"):
        lifts = proved_lifts(bundle, SUITE, both=view == "both")
        export(tmp_path / "out", lifts, boxes, provenance(view), WORDS, form="minari")
        return minari.MinariDataset(tmp_path / "out" / "data")

    return made


def test_the_robots_view_has_its_spaces_and_all_that_makes_a_lift_again(written):
    lifts = written()
    with closing(ParallelLift(SUITE.scenarios[0])) as env:
        assert lifts.observation_space == env.observation_space("robot")
        assert lifts.action_space == env.action_space("robot")
    assert len(lifts) == 3, "the lift without a step is left out"
    assert lifts.total_steps == sum(len(lift) for lift in lifts)
    told = list(lifts.storage.get_episode_metadata(range(3)))
    assert [each["scenario"] for each in told] == [LIFTS[0], LIFTS[1], LIFTS[3]]
    assert {each["seed"] for each in told} == {41}
    assert [each["failure"] for each in told] == ["", "step 20: too tired", ""]
    about = lifts.storage.metadata["colift"]
    assert (about["suite_digest"], about["policy"]) == (SUITE.digest, "uneven")


@pytest.mark.parametrize("view", ["robot", "both"])
def test_a_lift_replays_in_the_environment_bit_for_bit(written, view):
    lifts = written(view)
    told = next(iter(lifts.storage.get_episode_metadata([0])))
    lift = lifts[0]
    with closing(parallel_env(told["behaviour"], told["subject"])) as env:
        env.reset(seed=0)
        env.lift.reset(int(told["seed"]))
        human = env.scripted_human()
        for step in range(len(lift)):
            own, other = env.lift.human_observation(), env.lift.partner_observation()
            moved = human.act(own)
            robot = lift.observations["robot"] if view == "both" else lift.observations
            assert np.array_equal(robot[step], other)
            action = lift.actions["robot"] if view == "both" else lift.actions
            if view == "both":
                assert np.array_equal(lift.observations["human"][step], own)
                assert np.array_equal(lift.actions["human"][step], moved)
            _, rewards, _, truncated, _ = env.step({"human": moved, "robot": action[step]})
            assert lift.rewards[step] == rewards["robot"]
            if view == "both":
                assert lift.infos["human_reward"][step + 1] == rewards["human"]
        assert truncated["robot"]
    assert lift.truncations[-1]


def test_a_drop_is_told(dropped, boxes, provenance, tmp_path):
    export(tmp_path / "out", [dropped], boxes, provenance(), WORDS, form="minari")
    lifts = minari.MinariDataset(tmp_path / "out" / "data")
    assert "inclined" in next(iter(lifts.storage.get_episode_metadata([0])))["dropped"]
    assert (lifts[0].terminations[-1], lifts[0].truncations[-1]) == (True, False)
    assert "| dropped tables | 1 |" in (tmp_path / "out" / "README.md").read_text()


def test_a_seed_of_a_hidden_suite_survives(bundle, boxes, provenance, tmp_path):
    lifts = [
        dataclasses.replace(lift, seed=2**127 + 1)
        for lift in proved_lifts(bundle, SUITE)
        if lift.steps
    ]
    export(tmp_path / "out", lifts, boxes, provenance(), WORDS, form="minari")
    kept = minari.MinariDataset(tmp_path / "out" / "data")
    assert next(iter(kept.storage.get_episode_metadata([0])))["seed"] == 2**127 + 1


def test_minari_finds_a_set_by_its_name(written, tmp_path, monkeypatch):
    written()
    root = tmp_path / "sets"
    (root / "colift").mkdir(parents=True)
    (tmp_path / "out").rename(root / "colift" / "four-uneven-v0")
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(root))
    lifts = minari.load_dataset("colift/four-uneven-v0")
    assert lifts.recover_environment().observation_space == lifts.observation_space


def test_a_human_at_the_robots_end_is_converted(tmp_path, provenance):
    plan = set_plan("human", 1)
    [lift] = play_set(plan)
    assert lift.robot.observations.shape == (lift.steps + 1, len(RobotObservation))
    command = lift.robot.observations[:, RobotObservation.HAND_COMMAND]
    assert np.allclose(np.diff(command), lift.robot.actions[:, 0], atol=1e-15)
    boxes = spaces(plan[0].scenario, converted=True)
    assert boxes.actions["robot"].contains(lift.robot.actions[5])
    assert boxes.observations["robot"].contains(lift.robot.observations[5])
    [whole] = play_set(set_plan("human", 1, both=True))
    assert whole.robot.actions.shape == (whole.steps, 10)
    assert whole.state == lift.state


def test_equal_exports_have_equal_bytes(bundle, boxes, provenance, tmp_path):
    for name in ("one", "other"):
        lifts = proved_lifts(bundle, SUITE)
        export(tmp_path / name, lifts, boxes, provenance(), WORDS, form="minari")
    for path in (tmp_path / "one").rglob("*"):
        if path.is_file():
            other = tmp_path / "other" / path.relative_to(tmp_path / "one")
            assert path.read_bytes() == other.read_bytes(), path.name


def test_an_export_that_fails_or_is_interrupted_leaves_nothing(bundle, boxes, provenance, tmp_path):
    for error in (InputError("bad"), KeyboardInterrupt()):

        def broken(error=error):
            yield next(proved_lifts(bundle, SUITE))
            raise error

        with pytest.raises(type(error)):
            export(tmp_path / "out", broken(), boxes, provenance(), WORDS, form="minari")
        assert list(tmp_path.iterdir()) == []


def test_only_an_older_export_is_replaced_and_only_if_asked(bundle, boxes, provenance, tmp_path):
    def again(**options):
        lifts = proved_lifts(bundle, SUITE)
        export(tmp_path / "out", lifts, boxes, provenance(), WORDS, form="minari", **options)

    again()
    (tmp_path / "out" / "mine.txt").touch()
    with pytest.raises(InputError, match="is there already; name a new folder, or add --force"):
        again()
    with pytest.raises(InputError, match=r"out holds other files \(mine.txt\); name a new folder"):
        again(replace=True)
    (tmp_path / "out" / "mine.txt").unlink()
    again(replace=True)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "README.md",
        "colift.json",
        "croissant.json",
        "data",
    ]
    assert json.loads((tmp_path / "out" / "colift.json").read_text())["policy"] == "uneven"
    (tmp_path / "out" / "colift.json").unlink()
    with pytest.raises(InputError, match=r"is not an export \(it has no colift\.json\)"):
        again(replace=True)
