"""Text that people edit, by one set of rules: its encoding, its line ends, its numbers.

An editor may write a byte order mark, and end lines as Windows or an old Mac does; both are read. A
text in another encoding than UTF-8 is refused by the name of the encoding.
"""

import codecs
import tomllib
from pathlib import Path
from typing import Any, Final

from colift.base.errors import InputError

MARKS: Final = (
    (codecs.BOM_UTF32_LE, "UTF-32"),
    (codecs.BOM_UTF32_BE, "UTF-32"),
    (codecs.BOM_UTF16_LE, "UTF-16"),
    (codecs.BOM_UTF16_BE, "UTF-16"),
)
"""Byte order marks of other encodings; that of UTF-32 begins with that of UTF-16."""

INTEGER_BITS: Final = 63
"""Bits of the largest whole number of TOML, besides its sign (toml.io/en/v1.0.0#integer)."""


def read_bytes(path: Path, largest: int) -> bytes:
    """Return the content of a file.

    Parameters
    ----------
    path
        The file.
    largest
        Largest allowed number of bytes; more are not read.

    Raises
    ------
    InputError
        If it cannot be read, or is larger.
    """
    try:
        with path.open("rb") as file:
            data = file.read(largest + 1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:  # A name with a null character.
        raise InputError(f"{str(path)!r}: cannot be read: {error}") from None
    if len(data) > largest:
        raise InputError(f"{path} has more than {largest} bytes")
    return data


def decoded(data: bytes, where: str) -> str:
    r"""Return a text without its byte order mark, each line ended by ``\n``.

    Parameters
    ----------
    data
        The content of a file.
    where
        The file's name, for messages.

    Raises
    ------
    InputError
        If it is not UTF-8; the message names the encoding that it seems to have, and the place.
    """
    for mark, name in MARKS:
        if data.startswith(mark):
            raise InputError(f"{where}: must be UTF-8, is {name}: save it as UTF-8")
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        wide = data[::2].count(0) > len(data) // 8 or data[1::2].count(0) > len(data) // 8
        kind = "looks like UTF-16: save it as UTF-8" if wide else "has null bytes: it is no text"
        raise InputError(f"{where}: must be UTF-8, {kind}")
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        line = 1 + data.count(b"\n", 0, error.start)
        raise InputError(
            f"{where}: must be UTF-8; byte {error.start} is not (0x{data[error.start]:02x}, line "
            f"{line}): {_other_encoding(data)}"
        ) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _other_encoding(data: bytes) -> str:
    """Return a guess at the encoding of data that are not UTF-8."""
    if any(byte < 32 and byte not in b"\t\n\f\r\x1a" for byte in data):
        return "it is no text"
    name = "Windows-1252" if any(0x80 <= byte < 0xA0 for byte in data) else "Latin-1"
    return f"it looks like {name}: save it as UTF-8"


def parse_toml(data: bytes, where: str) -> dict[str, Any]:
    """Return the content of a TOML file.

    Parameters
    ----------
    data
        Its bytes; the time to read TOML can grow with the square of their number.
    where
        The file's name, for messages.

    Raises
    ------
    InputError
        As :func:`decoded`, or if it is not TOML, is nested too deeply, or has a whole number of
        more than 64 bits, which TOML does not allow.
    """
    text = decoded(data, where)
    try:
        content = tomllib.loads(text)
    except RecursionError:
        raise InputError(f"{where}: lists or tables are nested too deeply") from None
    except ValueError as error:
        raise InputError(f"{where}: {error}") from None
    _check_integers(content, where)
    return content


def _check_integers(content: dict[str, Any], where: str) -> None:
    """Refuse whole numbers that TOML does not allow, and name their keys."""
    waiting: list[tuple[str, Any]] = [("", content)]
    while waiting:
        name, value = waiting.pop()
        if isinstance(value, dict):
            waiting += [(f"{name}.{key}" if name else key, each) for key, each in value.items()]
        elif isinstance(value, list):
            waiting += [(name, each) for each in value]
        elif isinstance(value, int) and not -(1 << INTEGER_BITS) <= value < 1 << INTEGER_BITS:
            raise InputError(
                f"{where}: {name:.80} must be from -2^{INTEGER_BITS} to 2^{INTEGER_BITS} - 1, as "
                f"any whole number of TOML; got a number of {value.bit_length()} bits"
            )
