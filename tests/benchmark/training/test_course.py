"""The folder of a training: resumed, refused, never half-written."""

import errno
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from colift.agents.submissions.submission import read_submission
from colift.base.errors import InputError
from colift.benchmark.training import course as courses
from colift.benchmark.training.course import Point, open_course, write_summary, write_whole
from colift.benchmark.training.result import write_policy


@dataclass
class Settings:
    lifts: int = 3
    rate: float = 0.1


STATE = {"mean": np.arange(3.0)}
SHAPES = {"mean": (3,)}
WEIGHTS = {
    "linear": np.zeros(9),
    "w0": np.zeros((2, 9)),
    "b0": np.zeros(2),
    "w1": np.zeros((1, 2)),
    "b1": np.zeros(1),
}


def kept(folder, seed=0):
    course = open_course(folder, "cem", Settings(), seed)
    course.keep(Point(100, 1.5, 9.25), STATE)
    course.keep(Point(200, 3.0, 8.0), {"mean": STATE["mean"] + 1})
    return course


def test_state_and_curve_are_restored(tmp_path):
    kept(tmp_path)
    course = open_course(tmp_path, "cem", Settings(), 0)
    assert (course.load(SHAPES)["mean"] == STATE["mean"] + 1).all()
    assert (course.steps, course.seconds) == (200, 3.0)
    assert (tmp_path / "seed-0.csv").read_text() == (
        "steps,seconds,rmse_mm\n100,1.5,9.250\n200,3.0,8.000\n"
    )
    assert open_course(tmp_path, "cem", Settings(), 1).load(SHAPES) is None
    assert write_summary([course]).read_text() == "seed,steps,rmse_mm\n0,200,8.000\n"


@pytest.mark.parametrize(
    ("trainer", "settings", "told"),
    [
        ("ppo", Settings(), "trainer is cem, not ppo; give the same settings, or another folder"),
        ("cem", Settings(lifts=4), "lifts is 3, not 4"),
    ],
)
def test_another_training_is_refused_by_name(tmp_path, trainer, settings, told):
    kept(tmp_path)
    with pytest.raises(InputError, match=f"settings.json is of another training: {told}"):
        open_course(tmp_path, trainer, settings, 0)


def test_a_checkpoint_of_another_observation_is_refused_by_name(tmp_path, monkeypatch):
    kept(tmp_path)
    monkeypatch.setattr(courses, "OBSERVATION", 2)
    (tmp_path / "settings.json").unlink()
    other = open_course(tmp_path / "other", "cem", Settings(), 0)
    (tmp_path / "seed-0.checkpoint.npz").rename(other.checkpoint)
    with pytest.raises(InputError, match=r"checkpoint.npz is of .*: observation is 1, not 2"):
        other.load(SHAPES)


@pytest.mark.parametrize(
    ("shapes", "told"),
    [
        ({"mean": (4,)}, r"mean must be \(4,\), got \(3,\)"),
        ({"deviation": ()}, r"deviation must be \(\), got nothing"),
    ],
)
def test_a_checkpoint_with_other_arrays_is_refused(tmp_path, shapes, told):
    with pytest.raises(InputError, match=told):
        kept(tmp_path).load(shapes)


def test_a_damaged_checkpoint_is_refused(tmp_path):
    course = kept(tmp_path)
    course.checkpoint.write_bytes(course.checkpoint.read_bytes()[:100])
    with pytest.raises(InputError, match="not a checkpoint"):
        course.load(SHAPES)


def test_a_folder_with_something_else_is_refused(tmp_path):
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(InputError, match="not empty and not that of a training"):
        open_course(tmp_path, "cem", Settings(), 0)
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"cannot use .*file"):
        open_course(tmp_path / "file", "cem", Settings(), 0)


def test_nan_is_not_kept(tmp_path):
    course = kept(tmp_path)
    for point, state in (
        (Point(300, 4.0, 7.0), {"mean": np.array([1.0, np.nan, 0.0])}),
        (Point(300, 4.0, float("nan")), STATE),
    ):
        with pytest.raises(InputError, match="not finite: the training has diverged"):
            course.keep(point, state)
    assert open_course(tmp_path, "cem", Settings(), 0).load(SHAPES)["mean"][0] == 1.0


def test_a_full_disk_leaves_the_last_checkpoint(tmp_path, monkeypatch):
    course = kept(tmp_path)
    before = course.checkpoint.read_bytes()

    def full(handle):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(InputError, match=r"cannot write .*checkpoint.npz: No space left"):
        course.keep(Point(300, 4.0, 7.0), STATE)
    with pytest.raises(InputError, match=r"cannot write .*: No space left"):
        write_policy(course, WEIGHTS, {"description": "a", "trained_on": "b"})
    assert course.checkpoint.read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {
        "settings.json",
        "seed-0.csv",
        "seed-0.checkpoint.npz",
    }


def test_a_file_is_replaced_as_a_whole(tmp_path):
    path = tmp_path / "a"
    write_whole(path, b"one")
    write_whole(path, b"two")
    assert path.read_bytes() == b"two"
    with pytest.raises(InputError, match="cannot write /nowhere/a"):
        write_whole(Path("/nowhere/a"), b"")


def test_the_result_is_a_submission_the_same_byte_for_byte(tmp_path):
    digests = []
    for _ in range(2):
        course = kept(tmp_path)
        folder = write_policy(course, WEIGHTS, {"description": "a line", "trained_on": "people"})
        submission = read_submission(folder)
        digests.append(submission.contents.digest)
    assert digests[0] == digests[1]
    assert submission.manifest.name == "cem seed 0"
    assert submission.manifest.trained_on == "people"


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"w1": np.full((1, 2), np.nan)}, "weights must be finite, w1"),
        ({"b0": np.zeros(3)}, r"w0 must be \(3, 9\) and b0 \(3,\), got"),
    ],
)
def test_weights_that_cannot_be_used_leave_no_submission(tmp_path, change, told):
    course = kept(tmp_path)
    with pytest.raises(InputError, match=f"trained weights cannot be used: {told}"):
        write_policy(course, {**WEIGHTS, **change}, {"description": "a", "trained_on": "b"})
    assert not course.policy.exists()
