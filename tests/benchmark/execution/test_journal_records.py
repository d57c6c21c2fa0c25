"""Records: what was written whole is read, whatever came after it."""

import io
import os

import pytest
from colift.benchmark.execution import records as records_of_files
from colift.benchmark.execution.records import HEAD, append_record

CONTENTS = [
    {"format": "a"},
    [0, {"seed": "9" * 40, "values": [-0.0, 1e-300, float("inf"), None, True]}],
    [1, b"\x00\xff" * 1000],
    "\ud800 no text",
]


def records(data):
    """The records of a file with these bytes."""
    return records_of_files.records(io.BytesIO(data))


@pytest.fixture
def written(tmp_path):
    """The bytes of a file with all contents."""
    handle = os.open(tmp_path / "file", os.O_RDWR | os.O_CREAT | os.O_APPEND)
    for content in CONTENTS:
        append_record(handle, content)
    os.close(handle)
    return (tmp_path / "file").read_bytes()


def test_records_are_read_as_they_were_written(written):
    found = list(records(written))
    assert [content for content, _ in found] == CONTENTS
    assert found[-1][1] == len(written)


def test_a_torn_record_is_dropped_wherever_it_was_torn(written):
    ends = [0, *(end for _, end in records(written))]
    for size in range(len(written)):
        whole = sum(end <= size for end in ends) - 1
        found = list(records(written[:size]))
        assert [content for content, _ in found] == CONTENTS[:whole]
        assert ends[whole] == (found[-1][1] if found else 0)


def test_a_changed_byte_ends_what_is_read(written):
    ends = [0, *(end for _, end in records(written))]
    for place in range(len(written)):
        changed = bytearray(written)
        changed[place] ^= 1
        before = sum(end <= place for end in ends[1:])
        assert [content for content, _ in records(bytes(changed))] == CONTENTS[:before]


@pytest.mark.parametrize("size", [1, HEAD.size, HEAD.size + 1, 4096])
def test_zeros_after_a_crash_are_no_records(written, size):
    assert len(list(records(written + bytes(size)))) == len(CONTENTS)
    assert list(records(bytes(size))) == []


def test_what_cannot_be_written_is_an_error(tmp_path):
    (tmp_path / "file").write_bytes(b"")
    handle = os.open(tmp_path / "file", os.O_RDONLY)
    with pytest.raises(OSError, match="Bad file descriptor"):
        append_record(handle, CONTENTS[0])
    os.close(handle)
