"""A stranger's zip archive: what comes out of it, and why nothing else does."""

import contextlib
import gzip
import io
import lzma
import re
import stat
import struct
import zipfile
from pathlib import Path

import pytest
from colift.agents.submissions.folder import LIMITS, FolderLimits, read_folder
from colift.agents.submissions.new import write_template
from colift.base.errors import InputError
from colift.leaderboard.storage.archive import DIRECTORY, pack_archive, unpack_archive
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

SMALL = FolderLimits(entries=6, file_bytes=2**21, total_bytes=3 * 2**20, depth=2)


def archive(*entries, compression=zipfile.ZIP_DEFLATED, comment=b""):
    """Return an archive of names, or (name or ZipInfo, content)."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", compression) as made:
        for entry in entries:
            name, content = entry if isinstance(entry, tuple) else (entry, b"x")
            made.writestr(name, content, compression)
        made.comment = comment
    return file


def special(name, mode):
    entry = zipfile.ZipInfo(name)
    entry.create_system, entry.external_attr = 3, mode << 16
    return entry


@pytest.fixture
def out(tmp_path):
    """Return what unpacks and returns the files, in a folder where an escape would be seen."""
    folder = tmp_path / "above" / "out"

    def run(file, limits=SMALL):
        folder.mkdir(parents=True)
        try:
            unpack_archive(file, folder, limits)
        finally:
            assert [path.name for path in (tmp_path / "above").iterdir()] == ["out"]
        found = [path for path in folder.rglob("*") if not path.is_dir()]
        assert all(stat.S_ISREG(path.lstat().st_mode) for path in found)
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}

    return run


def test_what_was_packed_comes_out_as_the_same_submission(tmp_path, out):
    folder = tmp_path / "mine"
    write_template(folder)
    (folder / "data").mkdir()
    (folder / "data/weights.bin").write_bytes(bytes(range(256)) * 5000)
    packed = [io.BytesIO(), io.BytesIO()]
    for file in packed:
        pack_archive(folder, file)
    assert packed[0].getvalue() == packed[1].getvalue()
    out(packed[0])
    assert read_folder(tmp_path / "above/out") == read_folder(folder)


@pytest.mark.parametrize("explicit", [True, False])
def test_a_folder_that_was_packed_itself_is_opened(out, explicit):
    entries = [("mine/", b"")] * explicit + ["mine/policy.toml", "mine/data/a", "__MACOSX/mine/._a"]
    assert set(out(archive(*entries))) == {"policy.toml", "data/a"}


def test_what_tools_leave_behind_is_left_out(out):
    left = (".git/config", "b/__pycache__/c.pyc", ".env", "Thumbs.db", "b/Desktop.ini")
    assert set(out(archive("a", *left))) == {"a"}


def test_a_nested_archive_is_just_a_file(out):
    inner = archive("../../escape").getvalue()
    assert out(archive(("inner.zip", inner))) == {"inner.zip": inner}


def test_an_archive_with_a_comment_is_read(out):
    assert set(out(archive("a", comment=b"made by a tool " * 400))) == {"a"}


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        (["a", "../b"], r"zip entry \.\./b: .*\.\."),
        (["a", "b/../../c"], r"zip entry b/\.\./\.\./c: "),
        (["a", ".git/../../c"], r"zip entry \.git/\.\./\.\./c: "),
        (["./a"], r"zip entry \./a: "),
        (["/etc/passwd"], r"zip entry /etc/passwd: a name may not begin with /"),
        (["a//b"], "zip entry a//b: .*empty name"),
        (["a", "b\\c"], r"zip entry b\\c: .*backslash"),
        (["a", "C:b"], "zip entry C:b: a name may have"),
        (["a", "b c"], "zip entry b c: a name may have"),
        (["a", "<script>"], "zip entry <script>: a name may have"),
        (["a", "\u202eb"], r"zip entry '\\u202eb': a name may have"),
        (["a", "b" * 81], "a name may have at most 80"),
        (["x/y/z/a", "b"], "zip entry x/y/z/a: folders may be at most 2 deep"),
        (["a/" * 30_000 + "b", "c"], "folders may be at most 2 deep"),
        (["x/y/z/", "b"], "zip entry x/y/z/: folders may be at most 2 deep"),
        (["a", "b/policy.py", "B/other.py"], "zip entry B/other.py: .*'b'.*case"),
        (["policy.py", "Policy.py"], "zip entry Policy.py: .*'policy.py'.*case"),
        (["a", "a/b"], "zip entry a/b: 'a' is a file and a folder"),
        (["a/b", "a"], "zip entry a: 'a' is a file and a folder"),
        ([*"abcdefg"], "more than 6 files and folders"),
        (["a/1", "b/2", "c/3", "d/4"], "more than 6 files and folders"),
        ([special("a", stat.S_IFLNK | 0o777)], "zip entry a: a symbolic link"),
        ([special("a", stat.S_IFIFO)], "zip entry a: a device"),
        ([special("a", stat.S_IFCHR)], "zip entry a: a device"),
        ([special("a", stat.S_IFDIR)], "zip entry a: a device"),
        ([("a", bytes(2**21 + 1))], "zip entry a: a file may have at most 2 MiB, got 2 MiB"),
    ],
)
def test_an_entry_that_is_not_allowed_is_named_and_nothing_is_written(
    tmp_path, out, entries, message
):
    entries = [(each, b"x") if isinstance(each, zipfile.ZipInfo) else each for each in entries]
    with pytest.raises(InputError, match=message):
        out(archive(*entries))
    assert not list((tmp_path / "above/out").iterdir())


def test_a_bomb_is_refused_before_it_is_unpacked(tmp_path, out):
    bomb = archive(("a", b"x"), ("b", bytes(17 * 2**20)))
    with pytest.raises(InputError, match=r"become 17 MiB, more than 200 times larger"):
        out(bomb, LIMITS)
    assert not list((tmp_path / "above/out").iterdir())


def test_a_name_that_is_there_twice_is_refused(out):
    with pytest.warns(UserWarning, match="Duplicate"):
        file = archive(("a", b"1"), ("a", b"2"))
    with pytest.raises(InputError, match="zip entry a: it is there twice"):
        out(file)


def test_files_that_are_too_large_together_are_refused(out):
    noise = [(name, bytes(range(256)) * 4096 * 2) for name in "ab"]
    with pytest.raises(InputError, match="zip entry b: all files together may have at most 3 MiB"):
        out(archive(*noise, compression=zipfile.ZIP_STORED))


@pytest.mark.parametrize("compression", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_a_compression_that_can_need_much_memory_is_refused(out, compression):
    with pytest.raises(InputError, match="neither deflate nor none"):
        out(archive(("a", bytes(1000)), compression=compression))


def test_an_encrypted_entry_is_refused(out):
    content = bytearray(archive("a").getvalue())
    content[content.rindex(b"PK\x01\x02") + 8] |= 1
    with pytest.raises(InputError, match="zip entry a: it is encrypted"):
        out(io.BytesIO(content))


def test_more_bytes_than_an_entry_declares_do_not_come_out(tmp_path, out):
    """A bomb whose table of contents says that it is small."""
    content = bytearray(archive(("a", bytes(2**21))).getvalue())
    at = content.rindex(b"PK\x01\x02") + 24
    content[at : at + 4] = struct.pack("<I", 100)
    with pytest.raises(InputError, match="'a' is damaged"):
        out(io.BytesIO(content))
    assert (tmp_path / "above/out/a").stat().st_size <= 100


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "not a zip file, or cut off (0 bytes)"),
        (b"a token, in a file of its own\n", "not a zip file, or cut off (30 bytes)"),
        (b"\0" * 99, "not a zip file, or cut off (99 bytes)"),
        (b"PK\x03\x04" * 50, "a zip file that was cut off: upload it again (200 bytes)"),
        (b"PK\x05\x06", "a zip file that was cut off: upload it again (4 bytes)"),
        (gzip.compress(b"x", mtime=0), "a gzip file, not a zip file: pack the folder as a zip"),
        (lzma.compress(b"x"), "an xz file, not a zip file: pack the folder as a zip file"),
    ],
)
def test_what_is_no_archive_is_refused_as_what_it_is(out, content, told):
    with pytest.raises(InputError, match=re.escape(told)):
        out(io.BytesIO(content))


def test_text_files_get_the_line_ends_of_unix_and_others_stay_as_they_are(out):
    ends, marked = b"a = 1\r\n\r\nb = 2\r\r\nc\rd\n", b"\0a\r\n"
    entries = [("policy.py", ends), ("W.TXT", ends), ("data.npy", ends), ("binary.csv", marked)]
    unix = b"a = 1\n\nb = 2\nc\rd\n"
    assert out(archive(*entries)) == {
        "policy.py": unix, "W.TXT": unix, "data.npy": ends, "binary.csv": marked,
    }  # fmt: skip


def test_a_huge_table_of_contents_is_refused_before_it_is_read(out):
    content = bytearray(archive("a").getvalue())
    at = content.rindex(b"PK\x05\x06") + 12
    content[at : at + 4] = struct.pack("<I", DIRECTORY + 1)
    with pytest.raises(InputError, match="table of contents may have at most 2 MiB"):
        out(io.BytesIO(content))


def test_an_archive_that_says_it_needs_more_than_32_bits_is_refused(out):
    content = archive("a").getvalue()
    at = content.rindex(b"PK\x05\x06")
    locator = b"PK\x06\x07" + bytes(16)
    with pytest.raises(InputError, match="table of contents"):
        out(io.BytesIO(content[:at] + locator + content[at:]))


VALID = archive(("policy.toml", b"name = 1\n" * 20), "policy.py", "data/w").getvalue()


@settings(
    max_examples=300, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck)
)
@given(
    changes=st.lists(st.tuples(st.integers(0, len(VALID) - 1), st.integers(0, 255)), max_size=8),
    cut=st.integers(0, 40),
)
def test_a_damaged_archive_is_refused_or_stays_in_its_folder(tmp_path_factory, changes, cut):
    content = bytearray(VALID)
    for at, byte in changes:
        content[at] = byte
    above = tmp_path_factory.mktemp("above")
    folder = above / "out"
    folder.mkdir()
    with contextlib.suppress(InputError):
        unpack_archive(io.BytesIO(content[: len(content) - cut]), folder, SMALL)
    assert [path.name for path in above.iterdir()] == ["out"]
    assert all(path.is_dir() or path.is_file() for path in Path(folder).rglob("*"))
