"""Zip archives: packing of folders, and safe extraction of untrusted archives."""

import os
import stat
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, BinaryIO, Final

from colift.agents.submissions.folder import CHUNK, LIMITS, MIB, NAME, FolderLimits, is_part
from colift.agents.submissions.line_ends import is_text, with_unix_line_ends
from colift.base.errors import InputError

RATIO: Final = 200
"""Largest ratio of the size of all files to that of the archive."""

LARGE: Final = 16 * MIB
"""Total size from which :data:`RATIO` applies [bytes]: less is harmless at any ratio."""

DIRECTORY: Final = 2 * MIB
"""Largest table of contents [bytes]; it is read before anything in it can be checked."""

METHODS: Final = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
"""Compression methods whose memory is bounded."""

_END: Final = b"PK\x05\x06"
_END_SIZE: Final = 22
_END64: Final = b"PK\x06\x07"
_END64_SIZE: Final = 20
_LONGEST_COMMENT: Final = 2**16
_ENCRYPTED: Final = 0x1 | 0x40
_NOBODY: Final = (1980, 1, 1, 0, 0, 0)


def pack_archive(folder: Path, file: IO[bytes]) -> None:
    """Write the regular files of a folder as a zip archive; the same files give the same bytes."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(path for path in folder.rglob("*") if path.is_file()):
            entry = zipfile.ZipInfo(path.relative_to(folder).as_posix(), _NOBODY)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (stat.S_IFREG | 0o644) << 16
            entry.file_size = path.stat().st_size
            with path.open("rb") as source, archive.open(entry, "w") as target:
                while data := source.read(CHUNK):
                    target.write(data)


def unpack_archive(file: BinaryIO, folder: Path, limits: FolderLimits = LIMITS) -> list[str]:
    """Write the files of a zip archive into a folder; return their paths in the archive.

    The rules are those of :func:`.read_folder`; all names and declared sizes are checked before
    the first byte is written. What tools leave behind (:func:`.is_part`) is left out. If all other
    files lie in one folder, as when a folder itself was packed, that folder is left out of their
    paths. Text files get the line ends of Unix (:mod:`.line_ends`).

    Parameters
    ----------
    file
        The archive; it must be seekable.
    folder
        Destination: an existing empty folder that nobody else uses.
    limits
        Limits of the extracted files.

    Raises
    ------
    InputError
        If it is not a zip archive, is damaged, or an entry is not allowed; the message names the
        entry. The folder may then hold a part of the files.
    """
    size = _check_directory(file)
    with _readable("the archive"), zipfile.ZipFile(file) as archive:
        entries = _entries(archive, limits)
        _check_ratio(entries.values(), size)
        for path, entry in entries.items():
            place = folder / path
            place.parent.mkdir(parents=True, exist_ok=True)
            with _readable(path), archive.open(entry) as source, place.open("xb") as target:
                if is_text(path, entry.file_size):
                    target.write(with_unix_line_ends(source.read()))
                while data := source.read(CHUNK):
                    target.write(data)
        return [entry.orig_filename for entry in entries.values()]


def _check_directory(file: BinaryIO) -> int:
    """Refuse a table of contents that is too long, before zipfile reads it; return the size."""
    size = file.seek(0, os.SEEK_END)
    file.seek(max(size - _LONGEST_COMMENT - _END_SIZE - _END64_SIZE, 0))
    tail = file.read()
    at = tail.rfind(_END)
    if at < 0 or len(tail) - at < _END_SIZE:
        file.seek(0)
        raise InputError(f"{_kind(file.read(LONGEST_MARK))} ({size} bytes)")
    directory = int.from_bytes(tail[at + 12 : at + 16], "little")
    if tail[max(at - _END64_SIZE, 0) :].startswith(_END64) or directory > DIRECTORY:
        raise InputError(
            f"the zip archive's table of contents may have at most {DIRECTORY // MIB} MiB"
        )
    return size


MARKS: Final = {
    b"\x1f\x8b": "a gzip",
    b"BZh": "a bzip2",
    b"\xfd7zXZ": "an xz",
    b"7z\xbc\xaf\x27\x1c": "a 7z",
    b"Rar!": "a rar",
}
"""Other archives, by their first bytes."""

LONGEST_MARK: Final = max(map(len, MARKS))


def _kind(beginning: bytes) -> str:
    """Return what a file is that has no end record of a zip archive."""
    for mark, name in MARKS.items():
        if beginning.startswith(mark):
            return f"{name} file, not a zip file: pack the folder as a zip file"
    if beginning.startswith(b"PK"):
        return "a zip file that was cut off: upload it again"
    return "not a zip file, or cut off"


def _check_ratio(entries: Iterable[zipfile.ZipInfo], size: int) -> None:
    """Refuse an archive that would become much larger, whatever sizes it declares."""
    total = sum(entry.file_size for entry in entries)
    if total > max(LARGE, RATIO * size):
        raise InputError(
            f"the zip archive of {size} bytes would become {total / MIB:.0f} MiB, more than "
            f"{RATIO} times larger"
        )


def _entries(archive: zipfile.ZipFile, limits: FolderLimits) -> dict[str, zipfile.ZipInfo]:
    """Return the files of the submission by their paths in it, all checked."""
    names: dict[tuple[str, ...], zipfile.ZipInfo] = {}
    for entry in archive.infolist():
        parts = _parts(entry)
        if all(map(is_part, parts)):
            if parts in names:
                raise _refused(entry, "it is there twice")
            names[parts] = entry
    above = _only_folder(names)
    inside = {parts[above:]: entry for parts, entry in names.items() if parts[above:]}
    for parts, entry in inside.items():
        _check_kind(entry)
        _check_names(entry, parts, limits)
    folders = {parts[:end] for parts in inside for end in range(1, len(parts))}
    if len(folders | inside.keys()) > limits.entries:
        raise InputError(f"the zip archive holds more than {limits.entries} files and folders")
    _check_collisions(inside)
    files = {"/".join(parts): entry for parts, entry in inside.items() if not entry.is_dir()}
    budget = limits.total_bytes
    for entry in files.values():
        _check_size(entry, limits)
        budget -= entry.file_size
        if budget < 0:
            most = limits.total_bytes // MIB
            raise _refused(entry, f"all files together may have at most {most} MiB")
    return files


def _parts(entry: zipfile.ZipInfo) -> tuple[str, ...]:
    """Return the names on an entry's path; one that could lead out of the folder is refused."""
    name = entry.orig_filename
    if "\\" in name:
        raise _refused(entry, "a name may not have a backslash; folders are separated by /")
    if name.startswith("/"):
        raise _refused(entry, "a name may not begin with /")
    parts = tuple(name.removesuffix("/").split("/"))
    if any(part in ("", ".", "..") for part in parts):
        raise _refused(entry, "a path may not have . or .. or an empty name in it")
    return parts


def _only_folder(names: dict[tuple[str, ...], zipfile.ZipInfo]) -> int:
    """Return 1 if everything lies in one folder, else 0."""
    first = {parts[0] for parts in names}
    alone = [entry for parts, entry in names.items() if len(parts) == 1]
    return int(len(first) == 1 and all(entry.is_dir() for entry in alone))


def _check_kind(entry: zipfile.ZipInfo) -> None:
    mode = stat.S_IFMT(entry.external_attr >> 16)
    if mode == stat.S_IFLNK:
        raise _refused(entry, "a symbolic link; a submission has regular files only")
    if mode not in (0, stat.S_IFDIR if entry.is_dir() else stat.S_IFREG):
        raise _refused(entry, "a device, pipe or the like; a submission has regular files only")
    if entry.flag_bits & _ENCRYPTED:
        raise _refused(entry, "it is encrypted; pack it without a password")
    if entry.compress_type not in METHODS:
        raise _refused(entry, "its compression is neither deflate nor none")
    if entry.header_offset < 0:
        raise _refused(entry, "it is damaged: its place is before the archive's beginning")


def _check_names(entry: zipfile.ZipInfo, parts: tuple[str, ...], limits: FolderLimits) -> None:
    if not all(map(NAME.fullmatch, parts)):
        raise _refused(entry, "a name may have at most 80 letters, digits and _ . + -, in ASCII")
    if len(parts) - (not entry.is_dir()) > limits.depth:
        raise _refused(entry, f"folders may be at most {limits.depth} deep")


def _check_collisions(inside: dict[tuple[str, ...], zipfile.ZipInfo]) -> None:
    """Refuse paths that differ only in case, and paths that are a file and a folder at once."""
    seen: dict[tuple[str, ...], tuple[tuple[str, ...], bool]] = {}
    for parts, entry in inside.items():
        for end in range(1, len(parts) + 1):
            path, folder = parts[:end], end < len(parts) or entry.is_dir()
            key = tuple(part.casefold() for part in path)
            other = seen.setdefault(key, (path, folder))
            if other[0] != path:
                twin = ascii("/".join(other[0]))
                raise _refused(entry, f"it differs from {twin} in upper and lower case only")
            if other[1] != folder:
                raise _refused(entry, f"{'/'.join(path)!a} is a file and a folder")


def _check_size(entry: zipfile.ZipInfo, limits: FolderLimits) -> None:
    if entry.file_size > limits.file_bytes:
        message = f"a file may have at most {limits.file_bytes // MIB} MiB"
        raise _refused(entry, f"{message}, got {entry.file_size / MIB:.0f} MiB")


@contextmanager
def _readable(what: str) -> Iterator[None]:
    """Raise the many errors of zipfile for damaged archives as an InputError."""
    try:
        yield
    except InputError:
        raise
    except (
        zipfile.BadZipFile,
        zlib.error,
        EOFError,
        NotImplementedError,
        RuntimeError,
        ValueError,  # also what decoding raises
        OverflowError,
    ) as error:
        raise InputError(f"{what!a} is damaged, or not a zip archive: {error}") from error


def _refused(entry: zipfile.ZipInfo, reason: str) -> InputError:
    name = entry.orig_filename
    shown = name if name.isascii() and name.isprintable() else ascii(name)
    return InputError(f"zip entry {shown[:200]}: {reason}")
