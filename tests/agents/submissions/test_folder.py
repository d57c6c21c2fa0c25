"""Reading the folder of a stranger: what it may hold, and what must not happen."""

import contextlib
import os
import socket
import subprocess

import pytest
from colift.agents.submissions import folder as folders
from colift.agents.submissions.folder import FolderLimits, copy_folder, read_folder
from colift.base.errors import InputError


@pytest.fixture
def mine(tmp_path):
    folder = tmp_path / "mine"
    (folder / "data").mkdir(parents=True)
    (folder / "policy.py").write_text("class Policy: pass\n")
    (folder / "data" / "weights.bin").write_bytes(bytes(range(256)))
    return folder


def link_to_file(folder):
    (folder / "data" / "shadow").symlink_to("/etc/passwd")


def link_to_nothing(folder):
    (folder / "gone").symlink_to("/nowhere")


def link_inside(folder):
    (folder / "again.py").symlink_to("policy.py")


def link_to_folder(folder):
    (folder / "etc").symlink_to("/etc", target_is_directory=True)


def link_upwards(folder):
    (folder / "up").symlink_to("..")


def pipe(folder):
    os.mkfifo(folder / "pipe")


def bound_socket(folder):
    # The path of a socket is short.
    with contextlib.chdir(folder), socket.socket(socket.AF_UNIX) as made:
        made.bind("talk")


def two_gigabytes(folder):
    with (folder / "weights.npz").open("wb") as file:
        file.truncate(2 * 2**30)


def ten_thousand_files(folder):
    for number in range(10_000):
        (folder / f"f{number}").touch()


def many_hidden_files(folder):
    for number in range(501):
        (folder / f".f{number}").touch()


def deep_folders(folder):
    for _ in range(200):
        folder = folder / "d"
        folder.mkdir()


def no_utf8(folder):
    (folder / os.fsdecode(b"caf\xe9.py")).touch()


def terminal_codes(folder):
    (folder / "\x1b[2J.py").touch()


def line_end(folder):
    (folder / "a\nb").touch()


def space(folder):
    (folder / "my weights.npz").touch()


def dash(folder):
    (folder / "-rf").touch()


def long_name(folder):
    (folder / ("a" * 200)).touch()


HOSTILE = {
    link_to_file: "data/shadow: a symbolic link; a submission has regular files only",
    link_to_nothing: "gone: a symbolic link",
    link_inside: "again.py: a symbolic link",
    link_to_folder: "etc: a symbolic link",
    link_upwards: "up: a symbolic link",
    pipe: "pipe: a pipe",
    bound_socket: "talk: a socket",
    two_gigabytes: "weights.npz: a file may have at most 128 MiB, got 2048 MiB",
    ten_thousand_files: "more than 500 files and folders",
    many_hidden_files: "more than 500 files and folders",
    deep_folders: "d/d/d/d/d/d: folders may be at most 5 deep",
    no_utf8: r"caf\udce9.py': a name may have at most 80 letters, digits",
    terminal_codes: r"\x1b[2J.py': a name may have",
    line_end: r"a\nb': a name may have",
    space: "my weights.npz: a name may have",
    dash: "-rf: a name may have",
    long_name: "aaa: a name may have",
}


@pytest.mark.parametrize(("put", "told"), HOSTILE.items(), ids=[each.__name__ for each in HOSTILE])
def test_what_is_no_plain_file_is_refused(mine, tmp_path, put, told):
    put(mine)
    target = tmp_path / "copy"
    target.mkdir()
    for read in (lambda: read_folder(mine), lambda: copy_folder(mine, target)):
        with pytest.raises(InputError) as caught:
            read()
        message = str(caught.value)
        assert message.startswith(str(mine))
        assert told in message
        assert len(message) < 1000
        assert message.isprintable()


def test_a_large_file_is_refused_before_it_is_read(mine, monkeypatch):
    two_gigabytes(mine)
    read = []
    monkeypatch.setattr(folders.os, "read", lambda *_: read.append(1) or b"")
    (mine / "policy.py").unlink()
    (mine / "data" / "weights.bin").unlink()
    with pytest.raises(InputError, match="2048 MiB"):
        read_folder(mine)
    assert read == []


def test_a_link_that_replaces_a_file_meanwhile_is_not_followed(mine, tmp_path, monkeypatch):
    secret = tmp_path / "secret"
    secret.write_text("secret")
    real = os.stat

    def swap(name, **options):
        status = real(name, **options)
        if name == "policy.py":
            (mine / name).unlink()
            (mine / name).symlink_to(secret)
        return status

    monkeypatch.setattr(folders.os, "stat", swap)
    target = tmp_path / "copy"
    target.mkdir()
    with pytest.raises(InputError, match=r"policy\.py"):
        copy_folder(mine, target)
    assert not (target / "policy.py").exists()


def test_a_folder_that_becomes_a_link_meanwhile_is_not_followed(mine, tmp_path, monkeypatch):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "secret").touch()
    real = os.stat

    def swap(name, **options):
        status = real(name, **options)
        if name == "data":
            (mine / name).rename(tmp_path / "old")
            (mine / name).symlink_to(elsewhere)
        return status

    monkeypatch.setattr(folders.os, "stat", swap)
    with pytest.raises(InputError, match="data"):
        read_folder(mine)


def test_a_file_that_grows_meanwhile_is_refused(mine, monkeypatch):
    real = os.fstat

    def grow(handle):
        status = real(handle)
        with (mine / "policy.py").open("a") as file:
            file.write("more")
        return status

    monkeypatch.setattr(folders.os, "fstat", grow)
    (mine / "data" / "weights.bin").unlink()
    with pytest.raises(InputError, match=r"policy.py: it grew while it was read"):
        read_folder(mine)


@pytest.mark.parametrize("path", ["nowhere", "mine/policy.py"])
def test_what_is_no_folder_is_refused(mine, tmp_path, path):
    with pytest.raises(InputError, match=f"{path}: (no such|not a) folder"):
        read_folder(tmp_path / path)


def test_names_and_sizes_are_told_in_order(mine):
    contents = read_folder(mine)
    assert contents.paths == ("data/weights.bin", "policy.py")
    assert contents.size == 256 + 19


def test_what_tools_leave_is_no_part(mine, tmp_path):
    before = read_folder(mine)
    for name in (".git", "__pycache__", "data/.cache"):
        (mine / name).mkdir()
        (mine / name / "left").touch()
    (mine / ".DS_Store").touch()
    assert read_folder(mine) == before
    target = tmp_path / "copy"
    target.mkdir()
    copy_folder(mine, target)
    assert sorted(path.name for path in target.rglob("*")) == ["data", "policy.py", "weights.bin"]


def test_a_copy_is_equal_and_said_to_be(mine, tmp_path):
    (mine / "empty").touch()
    target = tmp_path / "copy"
    target.mkdir()
    assert copy_folder(mine, target) == read_folder(mine) == read_folder(target)
    assert (target / "data" / "weights.bin").read_bytes() == bytes(range(256))


def test_the_digest_is_that_of_the_tool_sha256sum(mine):
    command = "sha256sum data/weights.bin policy.py | sha256sum"
    done = subprocess.run(command, shell=True, cwd=mine, capture_output=True, text=True, check=True)
    assert done.stdout.split()[0] == read_folder(mine).digest


@pytest.mark.parametrize("name", ["Thumbs.db", "desktop.ini", "data/Desktop.ini", "__MACOSX/x"])
def test_what_windows_and_the_finder_leave_behind_changes_no_digest(mine, name):
    before = read_folder(mine)
    (mine / name).parent.mkdir(exist_ok=True)
    (mine / name).write_text("left behind")
    assert read_folder(mine) == before


@pytest.mark.parametrize("ends", [b"\r\n", b"\r\r\n"])
def test_line_ends_change_no_digest_and_what_is_copied_has_those_of_unix(mine, tmp_path, ends):
    text = b"class Policy:\n    pass\n"
    (mine / "policy.py").write_bytes(text)
    (mine / "README.MD").write_bytes(text)
    before = read_folder(mine)
    for name in ("policy.py", "README.MD"):
        (mine / name).write_bytes(text.replace(b"\n", ends))
    assert read_folder(mine) == before
    target = tmp_path / "copy"
    target.mkdir()
    assert copy_folder(mine, target) == before
    assert (target / "policy.py").read_bytes() == text
    assert read_folder(target) == before


@pytest.mark.parametrize("name", ["weights.bin", "weights.npy", "weights", "marked.txt"])
def test_bytes_that_are_no_text_are_not_touched(mine, tmp_path, name):
    data = b"\x89PNG\r\n\x1a\n\0" + b"\r\n" * 9
    (mine / name).write_bytes(data)
    before = read_folder(mine).digest
    target = tmp_path / "copy"
    target.mkdir()
    copy_folder(mine, target)
    assert (target / name).read_bytes() == data
    (mine / name).write_bytes(data.replace(b"\r\n", b"\n"))
    assert read_folder(mine).digest != before


@pytest.mark.parametrize("change", ["byte", "name", "moved", "more"])
def test_every_change_changes_the_digest(mine, change):
    before = read_folder(mine).digest
    match change:
        case "byte":
            (mine / "policy.py").write_text("class Policy: pasS\n")
        case "name":
            (mine / "policy.py").rename(mine / "policy2.py")
        case "moved":
            (mine / "data" / "weights.bin").rename(mine / "weights.bin")
        case "more":
            (mine / "data" / "more").touch()
    assert read_folder(mine).digest != before


def test_everything_up_to_the_limits_is_taken(mine):
    limits = FolderLimits(entries=3, file_bytes=256, total_bytes=275, depth=1)
    assert len(read_folder(mine, limits).files) == 2
    for name, less in (("entries", 2), ("file_bytes", 255), ("total_bytes", 274), ("depth", 0)):
        with pytest.raises(InputError):
            read_folder(mine, FolderLimits(**{**vars(limits), name: less}))
