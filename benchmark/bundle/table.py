"""``episodes.csv``: one row an episode."""

import csv
import io
import math
from collections.abc import Sequence
from typing import Final

from ...agents.errors import InputError
from ..episode.episode import Episode
from ..episode.scores import METRICS, Scores
from ..episode.trace import Trace
from .files import EPISODES, TRACES

FIELDS: Final = ("behaviour", "subject", "trial", "seed", *METRICS, "reached", "failure")
"""The columns."""

LONGEST_REASON: Final = 1000
"""Characters of a failure's reason that are kept."""


def one_line(text: str) -> str:
    """Return a text that may be printed anywhere: in a line, without control characters."""
    shown = (c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    return "".join(shown)[:LONGEST_REASON]


def dump_table(episodes: Sequence[Episode]) -> bytes:
    """Return one row an episode; an empty field where there is no value."""
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=FIELDS, lineterminator="\n")
    writer.writeheader()
    for episode in episodes:
        writer.writerow({name: _field(value) for name, value in episode.row().items()})
    return text.getvalue().encode()


def _field(value: object) -> object:
    if isinstance(value, float) and math.isnan(value):
        return ""
    return one_line(value) if isinstance(value, str) else value


def parse_table(data: bytes, traces: Sequence[Trace], logs: Sequence[str]) -> tuple[Episode, ...]:
    """Return the episodes of a table.

    Parameters
    ----------
    data
        The file.
    traces, logs
        What goes with each row.

    Raises
    ------
    InputError
        If it is not a table that :func:`dump_table` could have written.
    """
    try:
        rows = list(csv.reader(io.StringIO(data.decode(), newline=""), strict=True))
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{EPISODES}: not a CSV file in UTF-8: {error}") from None
    if not rows or tuple(rows[0]) != FIELDS:
        raise InputError(f"{EPISODES}: the first line must be {','.join(FIELDS)}")
    if len(rows) - 1 != len(traces):
        raise InputError(f"{EPISODES}: {len(rows) - 1} episodes, but {TRACES} has {len(traces)}")
    episodes = tuple(
        _episode(row, trace, log, f"{EPISODES}, row {number}")
        for number, (row, trace, log) in enumerate(zip(rows[1:], traces, logs, strict=True), 1)
    )
    written = dump_table(episodes)
    if written != data:
        lines = zip(written.split(b"\n"), data.split(b"\n"), strict=False)
        line = next((i for i, (a, b) in enumerate(lines, 1) if a != b), len(rows) + 1)
        raise InputError(f"{EPISODES}, line {line}: not as colift writes it")
    return episodes


def _episode(row: list[str], trace: Trace, log: str, where: str) -> Episode:
    if len(row) != len(FIELDS):
        raise InputError(f"{where}: {len(row)} fields, must be {len(FIELDS)}")
    values = dict(zip(FIELDS, row, strict=True))
    scores = {name: _number(values[name], f"{where}: {name}") for name in METRICS}
    for metric in METRICS.values():
        if metric.missing == "never" and math.isnan(scores[metric.name]):
            raise InputError(f"{where}: {metric.name} is missing")
    return Episode(
        behaviour=values["behaviour"],
        subject=values["subject"],
        trial=values["trial"],
        seed=_seed(values["seed"], f"{where}: seed"),
        scores=Scores(**scores),
        failure=values["failure"] or None,
        trace=trace,
        step_times=(),
        log=log,
    )


def _number(text: str, what: str) -> float:
    if not text:
        return math.nan
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{what} is {text!r:.80}, must be a finite number")
    return value


def _seed(text: str, what: str) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) <= 40):
        raise InputError(f"{what} is {text!r:.80}, must be a whole number")
    return int(text)
