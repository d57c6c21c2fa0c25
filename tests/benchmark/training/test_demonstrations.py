"""Demonstrations: what is recorded, and the file it is kept in."""

import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from colift.agents.senses import MOCAP_NOISE
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.paper.calibration import SEEDS
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.demonstrations import (
    COLUMNS,
    FIRST_SEED,
    LIFTS,
    SERIES,
    demonstrate,
    demonstrations,
    read_demonstrations,
    write_demonstrations,
)


@pytest.fixture(scope="module")
def lifts():
    return list(demonstrations(8))


@pytest.fixture
def file(lifts, tmp_path):
    path = tmp_path / "lifts.csv"
    write_demonstrations(path, lifts[:2])
    return path


def test_every_behaviour_is_shown_by_new_people(lifts):
    assert [each.behaviour for each in lifts] == [*BEHAVIOURS, *BEHAVIOURS]
    assert len({each.subject for each in lifts}) == 8
    assert all(re.fullmatch(r"draw-6000\d", each.subject) for each in lifts)


def test_no_seed_is_that_of_a_suite_or_of_the_calibration():
    seeds = set(range(FIRST_SEED, FIRST_SEED + LIFTS))
    for name in own_entries(SUITES):
        assert seeds.isdisjoint(make_suite(name).seeds)
    assert seeds.isdisjoint(range(*SEEDS))


def test_two_people_lift_and_lower_a_table_together(lifts):
    for each in lifts:
        human, partner = each["human_m"], each["partner_m"]
        assert human[0] == partner[0] == 0.0
        assert human.max() > 0.08
        assert abs(human[-1]) < 0.02
        assert 0.001 < np.sqrt(np.mean((human - partner) ** 2)) < 0.04


def test_samples_are_one_control_period_apart_from_the_start(lifts):
    for each in lifts:
        assert each.times == pytest.approx(0.1 * np.arange(len(each.times)), abs=1e-9)
        assert each.series.shape == (len(each.times), len(SERIES))


def test_velocities_are_those_of_the_heights(lifts):
    """The leader's by the trapezoidal rule; the demonstrator's varies within a control period."""
    for each in lifts:
        integral = 0.1 * np.cumsum((each["human_m_s"][1:] + each["human_m_s"][:-1]) / 2)
        assert integral == pytest.approx(each["human_m"][1:], abs=0.004)
        slopes = np.gradient(each["partner_m"], 0.1)
        assert np.corrcoef(slopes, each["partner_m_s"])[0, 1] > 0.7


def test_what_a_robot_sees_is_noisy_as_motion_capture_is(lifts):
    for end in ("human", "partner"):
        noise = np.concatenate([each[f"seen_{end}_m"] - each[f"{end}_m"] for each in lifts])
        assert noise.std() == pytest.approx(MOCAP_NOISE, rel=0.1)
        assert abs(noise.mean()) < MOCAP_NOISE / 5


def test_the_same_seed_demonstrates_the_same_wherever_it_runs(lifts):
    with ThreadPoolExecutor(2) as pool:
        again = list(demonstrations(2, executor=pool))
    for one, other in zip(lifts, again, strict=False):
        assert one.series.tobytes() == other.series.tobytes()
    assert demonstrate(FIRST_SEED + 1).series.tobytes() == lifts[1].series.tobytes()


def test_the_file_says_where_it_comes_from_and_is_read_back_to_the_bit(lifts, file):
    text = file.read_text().splitlines()
    assert text[0] == f"# colift demonstrate --lifts 2 --seed {FIRST_SEED}"
    assert all(line.startswith("#") for line in text[:3])
    assert text[3] == ",".join(COLUMNS)
    for one, other in zip(lifts, read_demonstrations(file), strict=False):
        assert (one.lift, one.behaviour, one.subject) == (
            other.lift,
            other.behaviour,
            other.subject,
        )
        assert one.times.tobytes() == other.times.tobytes()
        assert one.series.tobytes() == other.series.tobytes()


def test_another_labs_file_may_have_its_columns_in_any_order(lifts, tmp_path):
    path = tmp_path / "lifts.csv"
    names = list(reversed(COLUMNS))
    rows = [
        f"-0.25,0.1,0.2,0.3,0.4,0.5,{t},someone,lifting,7" for t in ("0", "0.05", "0.1", "0.15")
    ]
    path.write_text("\n".join([",".join(names), *rows]) + "\n")
    (found,) = read_demonstrations(path)
    assert (found.lift, found.behaviour, found.subject) == (7, "lifting", "someone")
    assert found["partner_m_s"].tolist() == [-0.25] * 4
    assert found["seen_human_m"].tolist() == [0.5] * 4


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (",human_m,", ",", r"lifts.csv: missing column\(s\) human_m$"),
        ("t_s,", "time,", r"missing column\(s\) t_s"),
        (",0.1,", ",often,", "line 6: t_s is 'often', must be a finite number"),
        (",0.1,", ",nan,", "line 6: t_s is 'nan'"),
        (",0.1,", ",0.15,", "lift 60000 are not evenly spaced in time"),
        (",0.1,", ",0,", "lift 60000 are not evenly spaced in time"),
        ("\n60000,smooth", "\nfirst,smooth", "line 5: lift is 'first', must be a whole number"),
    ],
)
def test_a_file_that_cannot_be_used_is_refused(file, old, new, told):
    file.write_text(file.read_text().replace(old, new, 1))
    with pytest.raises(InputError, match=told):
        read_demonstrations(file)


def test_files_that_are_none_are_refused(tmp_path):
    path = tmp_path / "lifts.csv"
    for content, told in (
        (b"", "missing column"),
        (b"# nothing\n" + ",".join(COLUMNS).encode(), "no samples, needs rows of lift,behav"),
        (b"\xff\xfe", "must be UTF-8, is UTF-16"),
    ):
        path.write_bytes(content)
        with pytest.raises(InputError, match=told):
            read_demonstrations(path)
    with pytest.raises(InputError, match="cannot be read: No such file"):
        read_demonstrations(tmp_path / "gone.csv")


@pytest.mark.parametrize(
    ("lifts", "seed", "told"),
    [
        (0, FIRST_SEED, "lifts must be at least 1, got 0"),
        (5, 101, "seeds for learning are 60000 to 199999, others are for tests; got 101 to 105"),
        (5, 199_997, "got 199997 to 200001"),
    ],
)
def test_the_suites_seeds_are_not_for_learning(lifts, seed, told):
    with pytest.raises(InputError, match=told):
        demonstrations(lifts, seed)
