"""LeRobot data sets: the layout of v3.0, read by pyarrow alone."""

import json

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.export import lerobot_writer
from colift.benchmark.export.exporting import CardWords, export
from colift.benchmark.export.lerobot_writer import frame_rate
from colift.benchmark.export.proving import proved_lifts

from .conftest import LIFTS, SUITE

parquet = pytest.importorskip("pyarrow.parquet")
WORDS = CardWords(about="Four lifts.", people="simulated", shows=("Little.",), licence="MIT")


@pytest.fixture
def written(bundle, boxes, provenance, tmp_path):
    """Return what exports the bundle, and gives the folder."""

    def made(view="robot"):
        lifts = proved_lifts(bundle, SUITE, both=view == "both")
        export(tmp_path / "out", lifts, boxes, provenance(view), WORDS, form="lerobot")
        return tmp_path / "out"

    return made


def column(table, name):
    return np.array(table.column(name).to_pylist())


def test_the_files_are_those_of_version_3(written):
    folder = written()
    files = sorted(str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file())
    assert files == [
        "README.md",
        "colift.json",
        "croissant.json",
        "data/chunk-000/file-000.parquet",
        "meta/episodes/chunk-000/file-000.parquet",
        "meta/info.json",
        "meta/stats.json",
        "meta/tasks.parquet",
    ]
    info = json.loads((folder / "meta/info.json").read_text())
    assert (info["codebase_version"], info["fps"], info["robot_type"]) == ("v3.0", 10, "nao")
    assert (info["total_episodes"], info["splits"]) == (3, {"train": "0:3"})
    first = info["data_path"].format(chunk_index=0, file_index=0)
    table = parquet.read_table(folder / first)
    assert table.num_rows == info["total_frames"]
    assert table.column_names == list(info["features"])
    for name, feature in info["features"].items():
        shape = column(table, name).shape
        assert shape == ((table.num_rows, *feature["shape"]) if shape[1:] else (table.num_rows,))
        assert shape[1:] or feature["shape"] == [1]


def test_the_rows_are_the_steps_in_single_precision(written, bundle):
    table = parquet.read_table(written("both") / "data")
    lifts = [lift for lift in proved_lifts(bundle, SUITE, both=True) if lift.steps]
    assert np.array_equal(
        column(table, "observation.state").astype(np.float32),
        np.concatenate([lift.robot.observations[:-1] for lift in lifts]).astype(np.float32),
    )
    assert np.array_equal(
        column(table, "action").astype(np.float32),
        np.concatenate([lift.robot.actions[:, 0] for lift in lifts]).astype(np.float32),
    )
    assert column(table, "human.observation").shape == (table.num_rows, 51)
    assert column(table, "human.action").shape == (table.num_rows, 10)
    ends = np.cumsum([lift.steps for lift in lifts]) - 1
    assert np.flatnonzero(column(table, "next.done")).tolist() == ends.tolist()
    assert column(table, "index").tolist() == list(range(table.num_rows))
    assert np.allclose(column(table, "timestamp"), column(table, "frame_index") / 10)


def test_the_table_of_episodes_says_where_each_lift_is(written):
    folder = written()
    data = parquet.read_table(folder / "data")
    rows = parquet.read_table(folder / "meta/episodes").to_pylist()
    assert [row["colift/scenario"] for row in rows] == [LIFTS[0], LIFTS[1], LIFTS[3]]
    assert [row["colift/seed"] for row in rows] == ["41"] * 3
    for row in rows:
        part = data.slice(row["dataset_from_index"], row["length"])
        assert set(column(part, "episode_index").tolist()) == {row["episode_index"]}
        assert row["dataset_to_index"] - row["dataset_from_index"] == row["length"]
        assert row["stats/action/max"] == [column(part, "action").max()]
        assert row["stats/observation.state/count"] == [row["length"]]
    stats = json.loads((folder / "meta/stats.json").read_text())
    state = column(data, "observation.state")
    assert np.allclose(stats["observation.state"]["mean"], state.mean(axis=0))
    assert np.allclose(stats["observation.state"]["q50"], np.median(state, axis=0))


def test_pandas_finds_a_task_by_its_words(written):
    pandas = pytest.importorskip("pandas")
    tasks = pandas.read_parquet(written() / "meta/tasks.parquet")
    assert tasks.loc[lerobot_writer.TASK].task_index == 0


def test_many_steps_are_split_into_files(written, monkeypatch):
    monkeypatch.setattr(lerobot_writer, "MOST_ROWS", 100)
    folder = written()
    names = sorted(path.name for path in (folder / "data/chunk-000").iterdir())
    assert names == ["file-000.parquet", "file-001.parquet"]
    rows = parquet.read_table(folder / "meta/episodes").to_pylist()
    assert [row["data/file_index"] for row in rows] == [0, 0, 1]
    assert parquet.read_table(folder / "data").num_rows == sum(row["length"] for row in rows)


def test_a_period_without_a_whole_number_of_steps_a_second_is_refused(provenance):
    with pytest.raises(InputError, match=r"0\.03 s has 33\.3333: export to minari"):
        frame_rate(provenance(control_period=0.03))
