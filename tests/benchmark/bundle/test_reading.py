"""Reading a bundle: exact, and without trust."""

import hashlib
import json
import os

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.bundle import read_bundle, read_files, results, write_bundle
from colift.benchmark.bundle.arrays import dump_arrays, parse_arrays
from colift.benchmark.bundle.files import other_files
from colift.benchmark.bundle.json_text import dump_json


def contents(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def put(folder, name, data):
    """Write a file and mend its hash."""
    (folder / name).write_bytes(data)
    path = folder / "manifest.json"
    manifest = json.loads(path.read_text())
    manifest["sha256"][name] = hashlib.sha256(data).hexdigest()
    path.write_bytes(dump_json(manifest))


def test_what_is_read_and_written_again_is_the_same_file_by_file(hostile, tmp_path):
    bundle = read_bundle(hostile)
    write_bundle(tmp_path / "copy", bundle.run(), bundle.results, platform=bundle.platform)
    assert contents(tmp_path / "copy") == contents(hostile)


def test_every_number_is_read_as_it_was(hostile_run, hostile):
    bundle = read_bundle(hostile)
    assert bundle.results == json.loads(json.dumps(results(hostile_run, {}).plain()))
    assert bundle.run().suite.digest == hostile_run.suite.digest
    for read, written in zip(bundle.episodes, hostile_run.episodes, strict=True):
        assert repr(read.scores) == repr(written.scores)
        assert (read.failure is None) == (written.failure is None)
        assert read.log == (written.log if written.failure else "")
        for name in (*read.trace.series(), "state"):
            one, other = getattr(read.trace, name), getattr(written.trace, name)
            assert one.tobytes() == other.tobytes()
            assert one.shape == other.shape


@pytest.mark.parametrize("name", ["results.json", "episodes.csv", "traces.npz", "logs.json"])
def test_any_changed_bit_of_a_file_is_refused(hostile, name):
    data = bytearray((hostile / name).read_bytes())
    data[len(data) // 2] ^= 1
    (hostile / name).write_bytes(data)
    with pytest.raises(InputError, match=name):
        read_bundle(hostile)


@pytest.mark.parametrize("share", [0.0, 0.5, 0.99])
@pytest.mark.parametrize(
    "name", ["results.json", "episodes.csv", "traces.npz", "logs.json", "manifest.json"]
)
def test_a_truncated_file_is_refused(hostile, name, share):
    data = (hostile / name).read_bytes()
    cut = data[: int(share * len(data))]
    if name == "manifest.json":
        (hostile / name).write_bytes(cut)
    else:
        put(hostile, name, cut)
    with pytest.raises(InputError, match=name):
        read_bundle(hostile)


@pytest.mark.parametrize("name", ["results.json", "episodes.csv", "traces.npz", "manifest.json"])
def test_a_missing_file_is_named(hostile, name):
    (hostile / name).unlink()
    with pytest.raises(InputError, match=f"{name}: it is missing"):
        read_bundle(hostile)


def test_logs_that_are_gone_are_missed(hostile):
    (hostile / "logs.json").unlink()
    with pytest.raises(InputError, match=r"logs\.json"):
        read_bundle(hostile)


def test_other_things_change_nothing_and_are_not_followed(hostile):
    before = read_files(hostile)
    (hostile / "notes").mkdir()
    (hostile / "policy.py").symlink_to("/dev/zero")
    os.mkfifo(hostile / ".DS_Store")
    assert read_files(hostile) == before
    assert read_bundle(hostile).results == json.loads(before["results.json"])
    assert other_files(hostile) == ["notes", "policy.py"]


def test_a_file_of_a_bundle_that_was_not_hashed_is_refused(hostile):
    (hostile / "inputs.npz").write_bytes(b"")
    with pytest.raises(InputError, match=r"inputs\.npz"):
        read_bundle(hostile)


def test_links_pipes_and_folders_are_not_followed(hostile, tmp_path):
    path = hostile / "logs.json"
    elsewhere = tmp_path / "elsewhere"
    path.rename(elsewhere)
    path.symlink_to(elsewhere)
    with pytest.raises(InputError, match=r"logs\.json: .*link"):
        read_bundle(hostile)
    path.unlink()
    os.mkfifo(path)
    with pytest.raises(InputError, match=r"logs\.json: not a plain file"):
        read_bundle(hostile)
    path.unlink()
    path.mkdir()
    with pytest.raises(InputError, match=r"logs\.json"):
        read_bundle(hostile)


def test_a_file_is_no_folder(tmp_path):
    (tmp_path / "file").write_text("")
    for name in ("file", "nowhere"):
        with pytest.raises(InputError, match=name):
            read_bundle(tmp_path / name)


@pytest.mark.parametrize(
    ("path", "value", "told"),
    [
        ("results.json:suite", 3, "suite must be a text, got 3"),
        ("results.json:scoring", True, "scoring must be a whole number"),
        ("results.json:complete", 1, "complete must be true or false"),
        ("results.json:policy", "copy", "policy.name is missing"),
        ("results.json:baselines", [], "baselines must be an object"),
        ("results.json:evaluator_faults", -1, "must be from 0"),
        ("results.json:summary", {"step_ms": {"p50": "fast"}}, "step_ms.p50 must be a number"),
        ("manifest.json:format", 2, "has format 2"),
        ("manifest.json:format", None, "format must be a whole number"),
        ("manifest.json:platform", {"numpy": 2}, "must be a text"),
        ("manifest.json:sha256", [], "sha256 must be an object"),
        ("manifest.json:recipe", None, "no recipe"),
        ("manifest.json:recipe", {}, "scenarios is missing"),
        ("logs.json:1000", "text", "no episode '1000'"),
        ("logs.json:1", 1, "must be a text"),
    ],
)
def test_a_value_of_the_wrong_kind_is_named(hostile, path, value, told):
    name, _, key = path.partition(":")
    content = json.loads((hostile / name).read_text())
    content[key] = value
    data = dump_json(content)
    if name == "manifest.json":
        (hostile / name).write_bytes(data)
    else:
        put(hostile, name, data)
    with pytest.raises(InputError, match=name) as caught:
        read_bundle(hostile)
    assert told in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"[]",
        b"null",
        b"\xff\xfe",
        b'{"a": NaN}',
        b'{"a": -Infinity}',
        b'{"a": 1e999}',
        b'{"a": 1, "a": 2}',
        b'{"a": ' + b"9" * 5000 + b"}",
        b"[" * 100_000,
    ],
)
@pytest.mark.parametrize("name", ["results.json", "manifest.json", "logs.json"])
def test_json_that_is_none_is_refused(hostile, name, text):
    if name == "manifest.json":
        (hostile / name).write_bytes(text)
    else:
        put(hostile, name, text)
    with pytest.raises(InputError, match=name):
        read_bundle(hostile)


def changed(folder, change):
    """Change the arrays of a bundle and mend the hash."""
    arrays = parse_arrays((folder / "traces.npz").read_bytes(), "traces.npz")
    change(arrays)
    put(folder, "traces.npz", dump_arrays(arrays))


def replaced(name, make):
    def change(arrays):
        arrays[name] = make(arrays[name].copy())

    return change


def at(index, value):
    def make(array):
        array[index] = value
        return array

    return make


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda arrays: arrays.pop("action"), "action is missing"),
        (lambda arrays: arrays.update(extra=np.zeros(1)), "'extra' is not an array"),
        (
            lambda arrays: arrays.update({"internals/a b": np.zeros(1)}),
            "is not an array of a bundle",
        ),
        (lambda arrays: arrays.update({"internals/a": np.zeros(1)}), "internals/a has 1 rows"),
        (replaced("human_end", lambda a: a[:-1]), "human_end has"),
        (replaced("human_end", lambda a: a.reshape(1, -1)), "must be <f8 of shape (any)"),
        (replaced("human_end", at(7, np.nan)), "human_end is not finite in row 7"),
        (replaced("action", at(7, np.inf)), "action is not finite in row 7"),
        (replaced("human_action", lambda a: a[:, :9]), "frames in"),
        (replaced("human_action", lambda a: a[:, :0]), "frames in"),
        (replaced("state", lambda a: a[:, :8]), "must be |u1 of shape ("),
        (replaced("state", lambda a: a.astype("<i8")), "state is <i8 of shape"),
        (replaced("frames", lambda a: a.astype("<f8")), "must be <i8 of shape (any)"),
        (replaced("frames", at(0, -10)), "negative"),
        (replaced("frames", at(0, 2**62)), "rows, must have"),
        (replaced("steps", lambda a: a + 1), "rows, must have"),
        (replaced("steps", lambda a: a[:-1]), "one number per episode"),
        (replaced("places", lambda a: a[::-1].copy()), "increase"),
        (replaced("places", at(-1, 8)), "no place 8"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(hostile, change, told):
    changed(hostile, change)
    with pytest.raises(InputError, match=r"traces\.npz") as caught:
        read_bundle(hostile)
    assert told in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("behaviour,", "who,"),
        ("smooth,S1,,3,", "smooth,S1,,three,"),
        ("smooth,S1,,3,", "smooth,S1,,-3,"),
        ("smooth,S1,,3,", "smooth,S1,,03,"),
        ("smooth,S1,,3,", 'smooth,"S1,,3,'),
        ("smooth,S1,,3,", "smooth,S1,,3,inf,"),
        ("smooth,S1,,3,", "smooth,S1,,3,,"),
        ("smooth,S1,,3,", "smooth,S1,,3,1e0,"),
        ("True,", "False,"),
        ("pause", "pau\rse"),
        ("pause", "pau\x00se"),
    ],
)
def test_a_table_that_colift_would_not_write_is_refused(hostile, old, new):
    text = (hostile / "episodes.csv").read_bytes().decode()
    assert old in text
    put(hostile, "episodes.csv", text.replace(old, new, 1).encode())
    with pytest.raises(InputError, match=r"episodes\.csv"):
        read_bundle(hostile)


def test_a_table_with_another_number_of_rows_is_refused(hostile):
    lines = (hostile / "episodes.csv").read_bytes().splitlines(keepends=True)
    put(hostile, "episodes.csv", b"".join(lines[:-1]))
    with pytest.raises(InputError, match=r"7 episodes, but traces\.npz has 8"):
        read_bundle(hostile)
