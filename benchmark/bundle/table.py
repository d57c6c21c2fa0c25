"""``episodes.csv``: one row per episode."""

import csv
import io
import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.bundle.files import EPISODES, TRACES
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import LEADING, Metrics, Scores, reached
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.catalogue import FROM_FILES
from colift.benchmark.suites.suite import Suite
from colift.benchmark.suites.treatments import TREATED, Treatments, treatments

NEEDED: Final = ("behaviour", "subject", "trial", "seed", LEADING, "failure")
"""Columns of every table, whatever the version of its scores."""

HUMAN_HUMAN_RMSE: Final = "human_human_rmse_mm"
"""Column of the RMSE of two people on the same lift [mm]: of the human-human baseline."""

LONGEST_REASON: Final = 1000
"""Characters of a failure's reason that are kept."""


def one_line(text: str) -> str:
    """Return a text on one line, without control characters."""
    shown = (c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    return "".join(shown)[:LONGEST_REASON]


def treated(suite: Suite) -> Treatments:
    """Return the treatments of a suite's recordings, by their trials as the table has them."""
    return {(one_line(trial), seed): each for (trial, seed), each in treatments(suite).items()}


def column_names(
    metrics: Metrics, *, human_human: bool = False, recorded: bool = False
) -> tuple[str, ...]:
    """Return the names of the columns.

    Parameters
    ----------
    metrics
        The metrics of the task.
    human_human
        Whether the error of two people on each lift is known.
    recorded
        Whether recordings were played.
    """
    names = ("behaviour", "subject", "trial", "seed", *metrics, "reached", "failure")
    return (
        *names,
        *((HUMAN_HUMAN_RMSE,) if human_human else ()),
        *(TREATED if recorded else ()),
    )


def table_row(
    episode: Episode,
    metrics: Metrics,
    played: Treatments | None = None,
    human_human_mm: float | None = None,
) -> dict[str, object]:
    """Return an episode as one row of the table, by column.

    Parameters
    ----------
    episode, metrics
        The episode and the metrics of its task.
    played
        Treatments of the recordings that were played, as of :func:`treated`, whose columns are the
        last; None or empty without recordings.
    human_human_mm
        RMSE of two people on the same lift [mm], whose column follows the failure; None if it is
        not known.
    """
    values = (
        episode.behaviour,
        episode.subject,
        episode.trial,
        episode.seed,
        *(episode.scores[name] for name in metrics),
        reached(episode.scores, metrics),
        episode.failure or "",
    )
    row: dict[str, object] = dict(zip(column_names(metrics), values, strict=True))
    if human_human_mm is not None:
        row[HUMAN_HUMAN_RMSE] = human_human_mm
    if played:
        of_file = episode.behaviour in FROM_FILES
        found = played.get((one_line(episode.trial), episode.seed)) if of_file else None
        row |= dict.fromkeys(TREATED, "") if found is None else found.plain()
    return row


def dump_table(
    episodes: Sequence[Episode],
    metrics: Metrics,
    played: Treatments | None = None,
    human_human_mm: Sequence[float] | None = None,
) -> bytes:
    """Return the table as a CSV file; the field of a missing value is empty.

    Arguments are as for :func:`table_row`; ``human_human_mm`` has a number for each episode.
    """
    data = io.BytesIO()
    text = io.TextIOWrapper(data, "utf-8", newline="")  # A long table is there once, as bytes.
    names = column_names(metrics, human_human=human_human_mm is not None, recorded=bool(played))
    writer = csv.DictWriter(text, fieldnames=names, lineterminator="\n")
    writer.writeheader()
    people = itertools.repeat(None) if human_human_mm is None else human_human_mm
    for episode, mm in zip(episodes, people, strict=human_human_mm is not None):
        row = table_row(episode, metrics, played, mm)
        writer.writerow({name: _field(value) for name, value in row.items()})
    text.flush()
    return data.getvalue()


def _field(value: object) -> object:
    if isinstance(value, float) and math.isnan(value):
        return ""
    return one_line(value) if isinstance(value, str) else value


def parse_table(
    data: bytes,
    traces: Sequence[Trace],
    logs: Sequence[str],
    metrics: Metrics,
    played: Treatments | None = None,
    *,
    outdated: bool = False,
) -> tuple[tuple[Episode, ...], tuple[float, ...] | None]:
    """Return the episodes of a table, and the RMSE of two people on each of them [mm].

    The latter is None in a table from before it was written, or without the human-human baseline.

    Parameters
    ----------
    data
        The file.
    traces, logs
        The trace and the output of each row's episode.
    metrics
        The metrics of the task.
    played
        As for :func:`table_row`. A table from before these were written lacks their columns.
    outdated
        Whether another version of the metrics computed the scores. A table may then have columns of
        other metrics, which are left out, and lack some, whose scores are NaN.

    Raises
    ------
    InputError
        If it is not a table that :func:`dump_table` of that version could have written.
    """
    try:
        rows = list(csv.reader(io.StringIO(data.decode(), newline=""), strict=True))
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{EPISODES}: not a CSV file in UTF-8: {error}") from None
    names = tuple(rows[0]) if rows else ()
    if outdated and not (len({*names}) == len(names) and {*NEEDED} <= {*names}):
        raise InputError(
            f"{EPISODES}: the first line must have {', '.join(NEEDED)}, and no name twice"
        )
    people = HUMAN_HUMAN_RMSE in names
    wanted = column_names(metrics, human_human=people, recorded=bool(played))
    if names == column_names(metrics, human_human=people):
        played = None
    elif not (outdated or names == wanted):
        raise InputError(f"{EPISODES}: the first line must be {','.join(wanted)}")
    if len(rows) - 1 != len(traces):
        raise InputError(f"{EPISODES}: {len(rows) - 1} episodes, but {TRACES} has {len(traces)}")
    episodes, human_human = [], []
    for number, (row, trace, log) in enumerate(zip(rows[1:], traces, logs, strict=True), 1):
        where = f"{EPISODES}, row {number}"
        if len(row) != len(names):
            raise InputError(f"{where}: {len(row)} fields, must be {len(names)}")
        values = dict(zip(names, row, strict=True))
        scores = _scores(values, metrics, where, outdated=outdated)
        episodes.append(_episode(values, scores, trace, log, where))
        if people:
            human_human.append(_number(values[HUMAN_HUMAN_RMSE], f"{where}: {HUMAN_HUMAN_RMSE}"))
            if math.isnan(human_human[-1]):
                raise InputError(f"{where}: {HUMAN_HUMAN_RMSE} is missing")
    known = tuple(human_human) if people else None
    written = _dump_rows(rows) if outdated else dump_table(episodes, metrics, played, known)
    if written != data:
        lines = zip(written.split(b"\n"), data.split(b"\n"), strict=False)
        line = next((i for i, (a, b) in enumerate(lines, 1) if a != b), len(rows) + 1)
        raise InputError(f"{EPISODES}, line {line}: not as colift writes it")
    return tuple(episodes), known


def _dump_rows(rows: Sequence[Sequence[str]]) -> bytes:
    """Return fields as a CSV file, in the form of :func:`dump_table` except for numbers."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([one_line(field) for field in row] for row in rows)
    return text.getvalue().encode()


def _episode(
    values: Mapping[str, str], scores: Scores, trace: Trace, log: str, where: str
) -> Episode:
    return Episode(
        behaviour=values["behaviour"],
        subject=values["subject"],
        trial=values["trial"],
        seed=_seed(values["seed"], f"{where}: seed"),
        scores=scores,
        failure=values["failure"] or None,
        trace=trace,
        step_times=(),
        log=log,
    )


def _scores(values: Mapping[str, str], metrics: Metrics, where: str, *, outdated: bool) -> Scores:
    """Return the scores in a row; NaN for a metric that an outdated table does not have."""
    scores = {name: _number(values.get(name, ""), f"{where}: {name}") for name in metrics}
    for metric in metrics.values():
        if metric.missing == "never" and math.isnan(scores[metric.name]) and not outdated:
            raise InputError(f"{where}: {metric.name} is missing")
    return scores


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
