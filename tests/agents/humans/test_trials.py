"""What is measured beside a lift: read with it, and refused with the same care."""

import numpy as np
import pytest
from colift.agents.humans import load_recordings, load_trials
from colift.base.errors import InputError

from .motion import lift

TIMES, HEIGHTS = lift()
FAR = HEIGHTS - 0.8 * np.sin(np.radians(3.0 * np.sin(TIMES)))
TILTS = 3.0 * np.sin(TIMES)
FORCES = 4.0 + np.sin(TIMES)
PHASES = np.where(TIMES < 1.0, "", "rise")


def changed(values, where, value):
    values = np.array(values, dtype=object)
    values[where] = value
    return values


def write(path, trial="a", heights=HEIGHTS, **columns):
    """Write a file with further columns, or add to it; return it."""
    text = "".join(
        ",".join((trial, f"{time:.4f}", f"{height:.5f}", *map(str, more))) + "\n"
        for time, height, *more in zip(TIMES, heights, *columns.values(), strict=True)
    )
    old = path.read_text() if path.exists() else ",".join(("trial", "t_s", "z_m", *columns)) + "\n"
    path.write_text(old + text)
    return path


@pytest.fixture
def path(tmp_path):
    return tmp_path / "lifts.csv"


def test_a_trial_has_what_was_measured_beside_the_hand(path):
    columns = {"z_far_m": FAR, "tilt_deg": TILTS, "force_n": FORCES, "phase": PHASES}
    (trial,) = load_trials(write(path, **columns))
    assert trial.far == pytest.approx(FAR.tolist())
    assert trial.tilts == pytest.approx(TILTS.tolist())
    assert trial.forces == pytest.approx(FORCES.tolist())
    assert trial.phases == tuple(PHASES)
    assert (trial.recording,) == load_recordings(path)


def test_what_is_beside_the_hand_changes_no_recording(path, tmp_path):
    write(path, z_far_m=FAR, force_n=FORCES)
    assert load_recordings(path) == load_recordings(write(tmp_path / "plain.csv"))


def test_a_column_may_be_empty_in_whole_trials(path):
    empty = np.full(len(TIMES), "")
    write(path, z_far_m=FAR, tilt_deg=empty)
    write(path, "b", HEIGHTS + 0.05 * np.sin(2 * TIMES), z_far_m=empty, tilt_deg=TILTS)
    first, second = load_trials(path)
    assert (len(first.far), first.tilts) == (len(TIMES), ())
    assert (second.far, len(second.tilts)) == ((), len(TIMES))


def test_two_columns_that_agree_about_the_table_are_read(path):
    (trial,) = load_trials(write(path, z_far_m=FAR + 0.012, tilt_deg=TILTS))
    assert len(trial.far) == len(trial.tilts) == len(TIMES)


FAULTS = {
    "a gap": ({"z_far_m": changed(FAR, slice(250, 259), "")}, 252, "z_far_m is nan or empty in 9"),
    "an unseen marker": ({"z_far_m": changed(FAR, 300, 0.0)}, 302, "z_far_m is 0 in 1 of 600"),
    "millimetres": ({"z_far_m": 1000 * FAR}, 2, "is z_far_m in metres. divide millimetres"),
    "a lost marker": (
        {"z_far_m": np.where(TIMES < 3.0, FAR, FAR + 0.3)},
        302,
        "z_far_m goes from .* lost or exchanged",
    ),
    "another origin": ({"z_far_m": FAR - 0.85}, 2, "0.85 m apart in height.*the same origin"),
    "one marker": ({"z_far_m": [f"{z:.5f}" for z in HEIGHTS]}, 2, "one marker in both columns"),
    "a word": ({"z_far_m": changed(FAR, 3, "up")}, 5, "z_far_m is 'up', must be a number$"),
    "a huge number": ({"z_far_m": changed(FAR, 3, 1e308)}, 5, "z_far_m goes from"),
    "a gap in the tilt": ({"tilt_deg": changed(TILTS, 9, "NaN")}, 11, "tilt_deg is nan or empty"),
    "a vertical table": ({"tilt_deg": 90.0 + TILTS}, None, "within 45 deg of 0, a level table"),
    "a tilt that jumps": (
        {"tilt_deg": np.where(TIMES < 3.0, TILTS, -TILTS - 12.0)},
        302,
        "tilt_deg goes from",
    ),
    "kilograms": ({"force_n": 1000 * FORCES}, None, "force_n is .*is it in newtons"),
    "a dead sensor": ({"force_n": np.zeros(len(TIMES))}, 2, "force_n is 0 in all samples"),
    "the other sign": ({"z_far_m": FAR, "tilt_deg": -TILTS}, None, "contradict each other"),
    "radians": ({"z_far_m": FAR, "tilt_deg": np.radians(TILTS)}, None, "in degrees, not radians"),
    "another table": (
        {"z_far_m": HEIGHTS - 0.1, "tilt_deg": TILTS},
        None,
        "z_far_m and tilt_deg contradict each other: at .* correct one of the two columns",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_an_artefact_beside_the_hand_is_refused_with_its_line_and_a_cure(path, name):
    columns, line, told = FAULTS[name]
    where = r"\d+" if line is None else str(line)
    with pytest.raises(InputError, match=rf"lifts.csv, line {where}: .*{told}") as caught:
        load_trials(write(path, **columns))
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize("column", ["phase", "z_far_m", "tilt_deg", "force_n"])
def test_a_column_that_is_there_twice_is_refused(path, column):
    path.write_text(f"trial,t_s,z_m,{column},{column}\na,0,0,1,1\n")
    with pytest.raises(InputError, match=f"the column {column} is there 2 times"):
        load_trials(path)
