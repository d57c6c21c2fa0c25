"""Reading and copying of submitted folders, in which nothing is trusted."""

import errno
import functools
import hashlib
import os
import re
import stat
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.agents.submissions.line_ends import is_text, with_unix_line_ends
from colift.base.errors import InputError

MIB: Final = 2**20
CHUNK: Final = MIB
"""Size of one read [bytes]."""

FULL: Final = frozenset({errno.ENOSPC, errno.EDQUOT})
"""Error numbers (errno) of a full disk."""

NAME: Final = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.+-]{0,79}")
"""Valid names of files and folders: none needs quoting on any system."""

LEFTOVERS: Final = frozenset({"__pycache__", "__macosx", "thumbs.db", "ehthumbs.db", "desktop.ini"})
"""Names, in small letters, of what Python, the Finder and Windows leave in folders and archives."""

if sys.platform != "win32":
    _OPEN: Final = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    _DIRECTORY: Final = _OPEN | os.O_DIRECTORY


class UnwritableError(OSError):
    """The target of a copy cannot be written to."""


@dataclass(frozen=True, kw_only=True)
class FolderLimits:
    """Limits on the size of a submission."""

    entries: int = 500
    """Number of files and folders."""
    file_bytes: int = 128 * MIB
    """Largest file [bytes]."""
    total_bytes: int = 256 * MIB
    """All files together [bytes]."""
    depth: int = 5
    """Levels of folders below the submission's own."""


LIMITS: Final = FolderLimits()


@dataclass(frozen=True, kw_only=True)
class File:
    """A regular file of a folder."""

    path: str
    """Its path in the folder, with ``/`` between the names."""
    size: int
    """Its size [bytes]."""
    sha256: str
    """Hash of its bytes, 64 hexadecimal digits; of a text file, with the line ends of Unix."""


@dataclass(frozen=True, kw_only=True)
class FolderContents:
    """The files of a folder, in the order of their paths."""

    files: tuple[File, ...]

    @property
    def paths(self) -> tuple[str, ...]:
        """The paths of the files."""
        return tuple(file.path for file in self.files)

    @property
    def size(self) -> int:
        """The size of all files [bytes]."""
        return sum(file.size for file in self.files)

    @functools.cached_property
    def digest(self) -> str:
        """SHA-256 (64 hexadecimal digits) over all names and bytes.

        It is the hash of the output of ``sha256sum`` for the files in the order of their paths, if
        text files have the line ends of Unix (:mod:`.line_ends`).
        """
        listing = "".join(f"{file.sha256}  {file.path}\n" for file in self.files)
        return hashlib.sha256(listing.encode()).hexdigest()


def is_part(name: str) -> bool:
    """Return whether a file or folder of this name belongs to a submission.

    Hidden ones and :data:`LEFTOVERS` do not: tools and systems leave them behind.
    """
    return not (name.startswith(".") or name.casefold() in LEFTOVERS)


def read_folder(folder: Path, limits: FolderLimits = LIMITS) -> FolderContents:
    """Return the files of a folder for which :func:`is_part` holds.

    Only regular files are accepted. No link is followed, not even one that appears during the
    reading, and no file is read before its size is checked.

    Raises
    ------
    InputError
        If it contains anything else, a name or size is not allowed, or it cannot be read; the
        message names the file.
    """
    return _walk(folder, limits, lambda path, data: None)


def copy_folder(folder: Path, target: Path, limits: FolderLimits = LIMITS) -> FolderContents:
    """Copy the files that :func:`read_folder` reads, and return them.

    Parameters
    ----------
    folder
        The folder to copy.
    target
        An existing, empty folder.
    limits
        As for :func:`read_folder`.

    Raises
    ------
    InputError
        As :func:`read_folder`; the target then holds a part of the files.
    UnwritableError
        If the target cannot be written to.
    """

    def keep(path: str, data: bytes) -> None:
        place = target / path
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            with place.open("ab") as file:
                file.write(data)
        except OSError as error:
            raise UnwritableError(error.errno, error.strerror) from error

    return _walk(folder, limits, keep)


def unwritable(place: Path, error: OSError) -> InputError:
    """Return the error for a folder that cannot be written to, such as one on a full disk."""
    if error.errno in FULL:
        return InputError(f"the disk of {place} is full: {error.strerror}; free some space there")
    return InputError(f"cannot write to {place}: {error.strerror}")


def _walk(folder: Path, limits: FolderLimits, keep: Callable[[str, bytes], None]) -> FolderContents:
    if not folder.is_dir():
        raise InputError(f"{folder}: " + ("not a folder" if folder.exists() else "no such folder"))
    files: list[File] = []
    budget = limits.total_bytes
    try:
        for path, size, chunks in _files(folder, limits):
            if size > budget:
                most = _mib(limits.total_bytes)
                raise _refused(folder, path, f"all files together may have at most {most}")
            sha, length = hashlib.sha256(), 0
            whole = _whole(folder, path, size, chunks)
            if is_text(path, size):
                whole = iter((with_unix_line_ends(b"".join(whole)),))
            for data in whole:
                length += len(data)
                sha.update(data)
                keep(path, data)
            keep(path, b"")
            budget -= length
            files.append(File(path=path, size=length, sha256=sha.hexdigest()))
    except UnwritableError:
        raise
    except OSError as error:
        where = f" ({error.filename!r})" if error.filename else ""
        raise InputError(f"cannot read {folder}: {error.strerror}{where}") from error
    return FolderContents(files=tuple(sorted(files, key=lambda file: file.path)))


def _whole(folder: Path, path: str, size: int, chunks: Iterator[bytes]) -> Iterator[bytes]:
    """Yield the bytes of a file; refuse one that becomes longer than it was."""
    length = 0
    for data in chunks:
        length += len(data)
        if length > size:
            raise _refused(folder, path, "it grew while it was read")
        yield data


def _files(folder: Path, limits: FolderLimits) -> Iterator[tuple[str, int, Iterator[bytes]]]:
    """Yield path, size and bytes of each file; everything is opened relative to its folder."""
    left = limits.entries

    def visit(directory: int, above: str, depth: int) -> Iterator[tuple[str, int, Iterator[bytes]]]:
        nonlocal left
        names = []
        with os.scandir(directory) as entries:
            for entry in entries:
                left -= 1
                if left < 0:
                    raise InputError(f"{folder} holds more than {limits.entries} files and folders")
                names.append(entry.name)
        for name in filter(is_part, sorted(names)):
            path = above + name
            if not NAME.fullmatch(name):
                raise _refused(
                    folder, path, "a name may have at most 80 letters, digits and _ . + -, in ASCII"
                )
            mode = os.stat(name, dir_fd=directory, follow_symlinks=False).st_mode
            if stat.S_ISDIR(mode):
                if depth == limits.depth:
                    raise _refused(folder, path, f"folders may be at most {limits.depth} deep")
                inner = os.open(name, _DIRECTORY, dir_fd=directory)
                try:
                    yield from visit(inner, f"{path}/", depth + 1)
                finally:
                    os.close(inner)
            elif stat.S_ISREG(mode):
                opened = os.open(name, _OPEN, dir_fd=directory)
                try:
                    status = os.fstat(opened)
                    if not stat.S_ISREG(status.st_mode):
                        raise _refused(folder, path, "it changed while it was read")
                    if status.st_size > limits.file_bytes:
                        most, size = _mib(limits.file_bytes), _mib(status.st_size)
                        raise _refused(folder, path, f"a file may have at most {most}, got {size}")
                    yield path, status.st_size, _chunks(opened)
                finally:
                    os.close(opened)
            else:
                raise _refused(folder, path, f"{_kind(mode)}; a submission has regular files only")

    root = os.open(folder, _DIRECTORY & ~os.O_NOFOLLOW)
    try:
        yield from visit(root, "", 0)
    finally:
        os.close(root)


def _chunks(opened: int) -> Iterator[bytes]:
    while data := os.read(opened, CHUNK):
        yield data


def _kind(mode: int) -> str:
    kinds = {stat.S_IFLNK: "a symbolic link", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket"}
    return kinds.get(stat.S_IFMT(mode), "a device")


def _mib(size: int) -> str:
    return f"{size / MIB:.0f} MiB"


def _refused(folder: Path, path: str, reason: str) -> InputError:
    shown = path if path.isascii() and path.isprintable() else ascii(path)
    return InputError(f"{folder}: {shown[:200]}: {reason}")
