"""Arrays in an ``.npz`` file: equal arrays give equal files, and no file is trusted."""

import io
import math
import warnings
import zipfile
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...agents.errors import InputError, error_text

MOST_BYTES: Final = 2**30
"""Bytes that all arrays of a file may take together, unpacked."""

MOST_RATIO: Final = 20
"""Bytes that arrays may take for each byte of their file. Those of lifts take less than 5, since
heights and forces have random last bits."""

MOST_ARRAYS: Final = 200
"""Arrays that a file may have."""

_ENTRY, _LISTED, _END = 30, 46, 22
"""Bytes that a zip file has before an entry, of an entry at its end, and after those, beside the
entries' names."""

_DATE: Final = (1980, 1, 1, 0, 0, 0)

DTYPES: Final = ("<f8", "<i8", "|u1")
"""Types that an array may have."""

Arrays = dict[str, NDArray[Any]]


def dump_arrays(arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Return the arrays as one ``.npz`` file, compressed, without pickles."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            # A fixed date, so that equal arrays give equal files.
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=_DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            with archive.open(entry, "w") as file:
                np.lib.format.write_array(file, array, version=(1, 0), allow_pickle=False)
    return data.getvalue()


def parse_arrays(data: bytes, file: str, most: int = MOST_BYTES) -> Arrays:
    """Return the arrays of an ``.npz`` file by name.

    What each array claims to be is checked before memory is taken for it.

    Parameters
    ----------
    data
        The file.
    file
        Its name, for messages.
    most
        Bytes that all arrays may take together.

    Raises
    ------
    InputError
        If it is not such a file, has anything else in it, or an array is of another type or larger
        than it may be.
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
        # A broken archive raises whatever its broken part makes the reader do.
        raise InputError(f"{file}: damaged, or not an .npz file: {error_text(error)}") from None


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
    """Refuse bytes before, between or after the entries, and whatever else no array needs."""
    place = 0
    for entry in entries:
        bare = not (entry.extra or entry.comment) and entry.date_time == _DATE
        if entry.header_offset != place or not bare:
            raise InputError(f"{file}: there is more than arrays at {entry.filename!r:.80}")
        place += _ENTRY + len(entry.filename.encode()) + entry.compress_size
    place += sum(_LISTED + len(entry.filename.encode()) for entry in entries)
    if archive.comment or place + _END != size:
        raise InputError(f"{file}: there is more than arrays at its end")


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
        # Without a size, zipfile would unpack first and see afterwards how much was claimed.
        return np.frombuffer(stream.read(size), dtype).reshape(shape)
