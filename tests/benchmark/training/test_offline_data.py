"""The steps of a Minari data set, as learners take them; other sets are refused by name."""

from dataclasses import replace

import numpy as np
import pytest
from colift.agents.submissions.offline.policy import Window
from colift.base.errors import InputError
from colift.benchmark.export.exporting import CardWords, export
from colift.benchmark.export.fixed_sets import play_set, set_digest, set_plan
from colift.benchmark.export.observing import spaces
from colift.benchmark.export.provenance import Provenance, of_scenario
from colift.benchmark.training.offline_data import read_data

pytest.importorskip("minari")
WORDS = CardWords(about="Lifts.", people="simulated", shows=("Little.",), licence="MIT")
PLAN = set_plan("follow", 2)


@pytest.fixture(scope="module")
def lifts():
    return list(play_set(PLAN))


@pytest.fixture
def written(lifts, tmp_path):
    """Return what writes a data set, with changes of the first lift's robot part."""

    def made(view="robot", plan=PLAN, shown=None, **changes):
        first, *rest = shown or lifts
        first = replace(first, robot=replace(first.robot, **changes))
        provenance = Provenance(
            name="two",
            source="test",
            policy="follow",
            policy_digest="0" * 16,
            suite="set follow",
            suite_digest=set_digest(plan),
            view=view,
            converted=False,
            **of_scenario(plan[0].scenario),
        )
        boxes = spaces(plan[0].scenario)
        export(tmp_path / "set", [first, *rest], boxes, provenance, WORDS, form="minari")
        return tmp_path / "set"

    return made


def test_steps_are_those_of_the_lifts(written, lifts):
    folder = written()
    data = read_data(folder)
    assert (data.name, data.lifts) == ("colift/two-v0", 2)
    assert data.steps == sum(lift.steps for lift in lifts)
    window = Window()
    seen = []
    for lift in lifts:
        window.reset()
        seen.append(np.array([window(each) for each in lift.robot.observations]))
    before = np.concatenate([each[:-1] for each in seen])
    after = np.concatenate([each[1:] for each in seen])
    assert data.inputs * data.deviation + data.centre == pytest.approx(before, abs=1e-6)
    assert data.coming * data.deviation + data.centre == pytest.approx(after, abs=1e-6)
    actions = np.concatenate([lift.robot.actions for lift in lifts])
    assert 0.04 * data.actions == pytest.approx(actions, abs=1e-8)
    assert data.rewards == pytest.approx(np.concatenate([lift.robot.rewards for lift in lifts]))
    assert not data.ended.any()
    assert read_data(folder / "data").digest == data.digest


def test_other_data_have_another_digest(written, lifts, tmp_path):
    digest = read_data(written()).digest
    (tmp_path / "set").rename(tmp_path / "older")
    assert read_data(written(actions=0.5 * lifts[0].robot.actions)).digest != digest


@pytest.mark.parametrize(
    ("name", "change", "told"),
    [
        ("observations", lambda x: with_nan(x), "lift 0: observations are not finite in step 7"),
        ("actions", lambda x: with_nan(x), "lift 0: actions are not finite in step 7"),
        ("rewards", lambda x: with_nan(x), "lift 0: rewards are not finite in step 7"),
        ("observations", lambda x: x[:-1], "lift 0: observations have the shape"),
        ("observations", lambda x: x[:, :4], "must be"),
        ("actions", lambda x: np.hstack((x, x)), "lift 0: actions have the shape"),
    ],
)
def test_bad_numbers_and_shapes_are_refused_by_name(written, lifts, name, change, told):
    folder = written(**{name: change(getattr(lifts[0].robot, name))})
    with pytest.raises(InputError) as refused:
        read_data(folder)
    assert told in str(refused.value)
    assert str(refused.value).startswith(f"{folder}: ")


def with_nan(array):
    changed = array.copy()
    changed[7] = np.nan
    return changed


def test_a_set_of_other_spaces_is_refused(written):
    plan = set_plan("follow", 1, both=True)
    folder = written("both", plan, list(play_set(plan)))
    with pytest.raises(InputError, match=r"its observations are not the robot's, .*Dict"):
        read_data(folder)


def test_a_set_of_two_humans_is_refused(written):
    plan = set_plan("human", 1, both=True)
    folder = written("robot", plan, list(play_set(plan)))
    with pytest.raises(InputError, match="its observations are not the robot's"):
        read_data(folder)


def test_what_is_no_data_set_is_refused(tmp_path, written):
    with pytest.raises(InputError, match=r"no Minari data set: there is no metadata\.json"):
        read_data(tmp_path)
    folder = written()
    file = folder / "data" / "main_data.hdf5"
    file.write_bytes(file.read_bytes()[:1000])
    with pytest.raises(InputError, match="a damaged data set"):
        read_data(folder)
