"""Mutations of a text, as transfers, editors, programs and mishaps make them."""

import os
import random
import re
from collections.abc import Iterator

COUNT = int(os.environ.get("COLIFT_TEST_MUTATIONS", "40"))
"""Mutations of each kind of file."""

NUMBERS = (
    "nan", "inf", "-inf", "-1", "0", "-0", "1e308", "-1e308", "1e-320", "1e999", "", "x", "1,5",
    "9" * 400, "-" + "9" * 400, "9" * 5000, "0x" + "f" * 400, "1_000", "\u0661", "true", "1e6",
)  # fmt: skip
BYTES = (
    b"\0", b"\xff", b"\xfc", b"\xef\xbb\xbf", b"\xff\xfe", b'"', b"\r", b"\n", b",", b";", b"#",
    b"[", b"{", b"=", b"\t", b" ", b"\x1b[2J", b"\xe2\x80\xae",
)  # fmt: skip


def mutations(data: bytes, seed: int) -> Iterator[bytes]:
    """Yield mutations of a file, each of one to four changes; the same for the same seed."""
    rng = random.Random(seed)
    for _ in range(COUNT):
        changed = data
        for _ in range(rng.randint(1, 4)):
            changed = rng.choice(CHANGES)(changed, rng)
        yield changed


def _number(data: bytes, rng: random.Random) -> bytes:
    found = list(re.finditer(rb"-?\d+(\.\d+)?(e-?\d+)?", data))
    if not found:
        return data
    at = rng.choice(found)
    return data[: at.start()] + rng.choice(NUMBERS).encode() + data[at.end() :]


def _flip(data: bytes, rng: random.Random) -> bytes:
    if not data:
        return data
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1 :]


def _insert(data: bytes, rng: random.Random) -> bytes:
    at = rng.choice((0, rng.randint(0, len(data)), len(data)))
    return data[:at] + rng.choice(BYTES) + data[at:]


def _cut(data: bytes, rng: random.Random) -> bytes:
    start = rng.randint(0, len(data))
    return data[:start] + data[start + rng.choice((1, 5, 50, 500, len(data))) :]


def _repeat(data: bytes, rng: random.Random) -> bytes:
    start = rng.randint(0, len(data))
    return data[:start] + data[start : start + rng.choice((1, 5, 50, 500))] + data[start:]


def _lines(data: bytes, rng: random.Random) -> bytes:
    lines = data.split(b"\n")
    first, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[first], lines[other] = lines[other], lines[first]
    return rng.choice((b"\n", b"\n", b"\r\n", b"\r", b"\n\n")).join(lines)


def _encoding(data: bytes, rng: random.Random) -> bytes:
    text = data.decode("latin-1")
    return text.encode(rng.choice(("utf-8-sig", "utf-16", "utf-16-le", "utf-32", "latin-1")))


def _column(data: bytes, rng: random.Random) -> bytes:
    rows = [line.split(b",") for line in data.split(b"\n")]
    drop = rng.randrange(max(map(len, rows)))
    return b"\n".join(b",".join(row[:drop] + row[drop + 1 :]) for row in rows)


CHANGES = (_number, _number, _number, _flip, _insert, _cut, _repeat, _lines, _encoding, _column)
