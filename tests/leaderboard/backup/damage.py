"""Damage to a backup, by chance with a seed: to its bytes, its files, the values in its tables."""

import gzip
import io
import json
import random
import sqlite3
import tarfile
from pathlib import Path

STRANGE = (None, "", "x", -1, 0, 2**63 - 1, 1e308, True, [], {}, b"\xff\x00", "\ud7ff", [1, "x"])


def damaged(content: bytes, seed: int, work: Path) -> bytes:
    """Return a damaged copy of a backup, packed again with the right checksums if need be."""
    chance = random.Random(seed)
    kind = ("packed", "plain", "file", "value", "json")[seed % 5]
    if kind == "packed":
        return flipped(content, chance)
    plain = gzip.decompress(content)
    if kind == "plain":
        return gzip.compress(flipped(plain, chance), 1)
    members = unpacked(plain)
    if kind == "file":
        name = chance.choice(sorted(members))
        members[name] = chance.choice((flipped(members[name], chance), b"", b"{}", b"null"))
    else:
        change = value_changed if kind == "value" else json_changed
        members["board.sqlite"] = table_changed(members["board.sqlite"], chance, work, change)
    return packed(members)


def flipped(content: bytes, chance: random.Random) -> bytes:
    """Return bytes of which some are others, are missing, or are there twice."""
    made = bytearray(content)
    at, length = chance.randrange(len(made) or 1), chance.choice((1, 4, 100))
    match chance.randrange(3):
        case 0:
            made[at : at + length] = chance.randbytes(length)
        case 1:
            del made[at : at + length]
        case _:
            made[at:at] = made[at : at + length]
    return bytes(made)


def unpacked(plain: bytes) -> dict[str, bytes]:
    """Return the files of an archive, in their order."""
    with tarfile.open(fileobj=io.BytesIO(plain)) as archive:
        return {each.name: archive.extractfile(each).read() for each in archive}


def packed(members: dict[str, bytes]) -> bytes:
    """Return the archive of some files."""
    file = io.BytesIO()
    with tarfile.open(fileobj=file, mode="w:gz", compresslevel=1) as archive:
        for name, content in members.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return file.getvalue()


def table_changed(content, chance, work, change):
    """Return a database with one value of one row exchanged."""
    path = work / "changed.sqlite"
    path.write_bytes(content)
    with sqlite3.connect(path) as connection:
        for (trigger,) in connection.execute("SELECT name FROM sqlite_master WHERE type='trigger'"):
            connection.execute(f"DROP TRIGGER {trigger}")
        change(connection, chance)
        connection.commit()
    connection.close()
    return path.read_bytes()


def value_changed(connection, chance):
    tables = [name for (name,) in connection.execute("SELECT name FROM sqlite_master")]
    known = ("seasons", "entries", "hidden_errors", "events", "jobs", "tokens", "workers")
    table = chance.choice([name for name in (*known, "rank_groups") if name in tables])
    columns = [each[1] for each in connection.execute(f"PRAGMA table_info({table})")]
    value = chance.choice([each for each in STRANGE if not isinstance(each, list | dict)])
    rows = [row for (row,) in connection.execute(f"SELECT rowid FROM {table}")]
    try:
        connection.execute(
            f'UPDATE {table} SET "{chance.choice(columns)}" = ? WHERE rowid = ?',
            (value, chance.choice(rows or [0])),
        )
    except sqlite3.IntegrityError:
        connection.execute(f"DELETE FROM {table}")


def json_changed(connection, chance):
    table, column = chance.choice((("entries", "row"), ("events", "content")))
    query = f'SELECT rowid, "{column}" FROM {table} WHERE "{column}" IS NOT NULL'
    row, text = chance.choice(connection.execute(query).fetchall())
    content = json.loads(text)
    place = content
    while True:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        key = chance.choice(keys)
        deeper = place[key]
        if isinstance(deeper, dict | list) and deeper and chance.random() < 0.7:
            place = deeper
            continue
        if chance.random() < 0.3:
            del place[key]
        else:
            place[key] = chance.choice([each for each in STRANGE if not isinstance(each, bytes)])
        break
    text = chance.choice((json.dumps(content), json.dumps(content), text[:-3]))
    connection.execute(f'UPDATE {table} SET "{column}" = ? WHERE rowid = ?', (text, row))
