"""Arrays in an ``.npz`` file: equal arrays give equal files, and no file is trusted."""

import io
import math
import warnings
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, BinaryIO, Final

import numpy as np
from colift.base.errors import InputError, error_text
from numpy.typing import NDArray

MOST_BYTES: Final = 2**32
"""Largest size of all arrays of a file together, unpacked [bytes]."""

MOST_RATIO: Final = 20
"""Largest ratio of the size of the arrays to that of their file. It is below 5 for lifts, since
heights and forces have random last bits."""

MOST_ARRAYS: Final = 200
"""Largest number of arrays in a file."""

_ENTRY, _LISTED, _END = 30, 46, 22
"""Sizes in a zip file [bytes], without names: the head of an entry, its row in the directory, and
the end of the directory."""

_DATE: Final = (1980, 1, 1, 0, 0, 0)

DTYPES: Final = ("<f8", "<i8", "|u1")
"""Allowed types of an array."""

Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True, kw_only=True, eq=False)
class Parts:
    """An array that is written part by part, along its first axis."""

    dtype: str
    """One of :data:`DTYPES`."""
    shape: tuple[int, ...]
    parts: Iterable[NDArray[Any]]


def write_arrays(file: BinaryIO, arrays: Iterable[tuple[str, Parts]]) -> None:
    """Write arrays into one ``.npz`` file, compressed, without pickles, one part in memory."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays:
            # A fixed date, so that equal arrays give equal files.
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            header = {"descr": array.dtype, "fortran_order": False, "shape": array.shape}
            with archive.open(entry, "w") as member:
                np.lib.format.write_array_header_1_0(member, header)
                for part in array.parts:
                    member.write(part.astype(array.dtype).tobytes())


def dump_arrays(arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Return the arrays as one ``.npz`` file; see :func:`write_arrays`."""
    data = io.BytesIO()
    whole = {
        name: Parts(dtype=array.dtype.str, shape=array.shape, parts=[array])
        for name, array in arrays.items()
    }
    write_arrays(data, whole.items())
    return data.getvalue()


def parse_arrays(data: bytes, file: str, most: int = MOST_BYTES) -> Arrays:
    """Return the arrays of an ``.npz`` file by name.

    The claimed type and size of an array are checked before memory is allocated for it.

    Parameters
    ----------
    data
        The file.
    file
        Its name, for messages.
    most
        Largest size of all arrays together [bytes].

    Raises
    ------
    InputError
        If it is not such a file, has any other content, or an array has a type or size that is not
        allowed.
    """
    try:
        with warnings.catch_warnings(), zipfile.ZipFile(io.BytesIO(data)) as archive:
            warnings.simplefilter("error")
            entries = archive.infolist()
            _check_directory(entries, file, min(most, MOST_BYTES, MOST_RATIO * len(data)))
            arrays = {
                entry.filename.removesuffix(".npy"): _array(archive, entry, file)
                for entry in entries
            }
            _check_layout(archive, entries, len(data), file)
            return arrays
    except (InputError, MemoryError):
        raise
    except Exception as error:
        # A damaged archive can raise anything.
        raise InputError(f"{file}: damaged, or not an .npz file: {error_text(error)}") from None


def take_array(
    arrays: Arrays, name: str, dtype: str, shape: tuple[int | None, ...], file: str
) -> NDArray[Any]:
    """Take an array out of those of a file.

    Parameters
    ----------
    arrays
        The arrays of the file, by name; this one is removed.
    name
        Its name.
    dtype
        The type that it must have, such as ``<f8``.
    shape
        The shape that it must have; None is any length.
    file
        Name of the file, for messages.

    Raises
    ------
    InputError
        If there is no such array, or it has another type or shape.
    """
    if name not in arrays:
        raise InputError(f"{file}: {name} is missing")
    array = arrays.pop(name)
    lengths = zip(array.shape, shape, strict=False)
    fits = array.ndim == len(shape) and all(due in (None, length) for length, due in lengths)
    if array.dtype.str != dtype or not fits:
        due = ", ".join("any" if length is None else str(length) for length in shape)
        raise InputError(
            f"{file}: {name} is {array.dtype.str} of shape {array.shape}, must be {dtype} of "
            f"shape ({due})"
        )
    return array


def _check_directory(entries: list[zipfile.ZipInfo], file: str, most: int) -> None:
    names = [entry.filename for entry in entries]
    if len(names) > MOST_ARRAYS:
        raise InputError(f"{file}: {len(names)} arrays, at most {MOST_ARRAYS} are read")
    if len(set(names)) < len(names):
        raise InputError(f"{file}: two arrays have the same name")
    size = sum(entry.file_size for entry in entries)
    if size > most:
        raise InputError(f"{file}: claims {size} bytes, at most {most} are read")
    for entry in entries:
        if not entry.filename.endswith(".npy") or entry.flag_bits & 1:
            raise InputError(f"{file}: {entry.filename!r:.80} is not a plain .npy array")
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise InputError(f"{file}: {entry.filename!r:.80} is compressed in an unknown way")


def _check_layout(
    archive: zipfile.ZipFile, entries: list[zipfile.ZipInfo], size: int, file: str
) -> None:
    """Refuse bytes before, between or after the entries, and unneeded parts of entries."""
    place = 0
    for entry in entries:
        bare = not (entry.extra or entry.comment) and entry.date_time == _DATE
        if entry.header_offset != place or not bare:
            raise InputError(f"{file}: only arrays are allowed, got more at {entry.filename!r:.80}")
        place += _ENTRY + len(entry.filename.encode()) + entry.compress_size
    place += sum(_LISTED + len(entry.filename.encode()) for entry in entries)
    if archive.comment or place + _END != size:
        raise InputError(f"{file}: only arrays are allowed, got more at its end")


def _array(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, file: str) -> NDArray[Any]:
    what = f"{file}: {entry.filename!r:.80}"
    with archive.open(entry) as stream:
        if np.lib.format.read_magic(stream) != (1, 0):
            raise InputError(f"{what} is not an array of format 1.0")
        shape, fortran, dtype = np.lib.format.read_array_header_1_0(stream)
        if dtype.str not in DTYPES or (fortran and len(shape) > 1):
            raise InputError(f"{what} is of type {dtype.str}, must be one of {', '.join(DTYPES)}")
        if len(shape) > 2 or min(shape, default=0) < 0:
            raise InputError(f"{what} has the shape {shape}, must have one or two dimensions")
        size = math.prod(shape) * dtype.itemsize
        if size != entry.file_size - stream.tell():
            raise InputError(f"{what} claims the shape {shape}, but has another size")
        # If read without a size, zipfile would unpack everything before it compares sizes.
        return np.frombuffer(stream.read(size), dtype).reshape(shape)
