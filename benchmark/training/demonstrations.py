"""Demonstrations: lifts of two simulated people, as a robot could learn from them.

The file begins with comment lines (``#``) that state its origin, followed by a header and a row for
each control period of each lift:

================ ====== ==========================================================================
lift                    number of the lift, its seed
behaviour               how the leading person moves
subject                 who leads, ``draw-N``
t_s              s      time since the episode began
seen_human_m     m      height of the leader's end: a motion-capture sample of this time, noisy;
                        a robot sees it when it is as old as its latency
seen_partner_m   m      the same of the demonstrator's end
human_m          m      height of the leader's end
human_m_s        m/s    its velocity at this time
partner_m        m      height of the demonstrator's end
partner_m_s      m/s    its velocity at this time
================ ====== ==========================================================================

The demonstrator stands at the robot's end. Heights are displacements from the table's rest height.
The demonstrator decides once per control period. The velocity of that end therefore varies within a
period: at the times of the samples it is about a quarter below its mean.
"""

import csv
import itertools
import math
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import SecondPerson
from colift.agents.senses import MOCAP_NOISE
from colift.base.errors import InputError
from colift.base.text import decoded, read_bytes
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.ranges import DEMONSTRATING_PEOPLE, LEARNING_PEOPLE
from colift.benchmark.tasks.level.task import BEHAVIOURS
from numpy.typing import NDArray

FIRST_SEED: Final = DEMONSTRATING_PEOPLE[0]
"""Seed of the first demonstration and number of its person, who is in no suite."""

LIFTS: Final = 400
"""Lifts from which a robot learns: 100 of each behaviour, each by another person."""

LARGEST: Final = 1024 * 1024 * 1024
"""Largest file of demonstrations [bytes]."""

SERIES: Final = (
    "seen_human_m",
    "seen_partner_m",
    "human_m",
    "human_m_s",
    "partner_m",
    "partner_m_s",
)
DIGITS: Final = 6
"""Decimals of every number, in files and in memory: micrometres."""

COLUMNS: Final = ("lift", "behaviour", "subject", "t_s", *SERIES)


@dataclass(frozen=True, kw_only=True, eq=False)
class Demonstration:
    """One lift of two simulated people, one sample per control period."""

    lift: int
    """Number of the lift, its seed."""
    behaviour: str
    """Behaviour of the leading person."""
    subject: str
    """Name of the leading person."""
    times: NDArray[np.float64]
    """(n,) time of each sample [s]."""
    series: NDArray[np.float64]
    """(n, 6) the columns :data:`SERIES`."""

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        """Return a column of :data:`SERIES`, shape (n,)."""
        values: NDArray[np.float64] = self.series[:, SERIES.index(column)]
        return values


def demonstrate(seed: int) -> Demonstration:
    """Return the lift of a seed: a new person, who moves with one of the suites' behaviours."""
    behaviour, subject = BEHAVIOURS[seed % len(BEHAVIOURS)], f"draw-{seed}"
    lift = Lift(make_scenario(behaviour, subject, partner="human"))
    lift.reset(seed)
    leader, demonstrator = lift.scripted_human(), SecondPerson()
    demonstrator.reset(derive_seed(seed, "demonstrator"))
    world = lift.world
    times, rows = [], []

    def record() -> None:
        times.append(lift.frame * FRAME)
        human, partner = world.human_end[-1], world.robot_end[-1]
        velocities = world.human_velocity[-1], world.robot_velocity[-1]
        rows.append((human, partner, human, velocities[0], partner, velocities[1]))

    record()
    while not lift.done:
        lift.step(
            leader.act(lift.human_observation()), demonstrator.act(lift.partner_observation())
        )
        record()
    lift.close()
    series = np.array(rows)
    sensor = np.random.default_rng(derive_seed(seed, "demonstration/sensor"))
    series[:, :2] += sensor.normal(0.0, MOCAP_NOISE, (len(rows), 2))
    return Demonstration(
        lift=seed,
        behaviour=behaviour,
        subject=subject,
        times=np.array([round(time, DIGITS) for time in times]),
        series=np.array([[round(value, DIGITS) for value in row] for row in series.tolist()]),
    )


def demonstrations(
    lifts: int = LIFTS, seed: int = FIRST_SEED, *, executor: Executor | None = None
) -> Iterator[Demonstration]:
    """Yield the lifts of the seeds ``seed`` to ``seed + lifts - 1``, in order.

    Raises
    ------
    InputError
        If there is no lift, or a person is not one to learn from.
    """
    if lifts < 1:
        raise InputError(f"lifts must be at least 1, got {lifts}")
    seeds = range(seed, seed + lifts)
    if not (seeds[0] in LEARNING_PEOPLE and seeds[-1] in LEARNING_PEOPLE):
        raise InputError(
            f"seeds for learning are {LEARNING_PEOPLE[0]} to {LEARNING_PEOPLE[-1]}, others are "
            f"for tests; got {seeds[0]} to {seeds[-1]}"
        )
    return map(demonstrate, seeds) if executor is None else executor.map(demonstrate, seeds)


def write_demonstrations(path: Path, lifts: Sequence[Demonstration]) -> None:
    """Write a file of demonstrations."""
    with path.open("w", newline="") as file:
        file.write(
            f"# colift demonstrate --lifts {len(lifts)} --seed {lifts[0].lift}\n"
            f"# colift {version('colift')}; two simulated people; a row every {CONTROL_PERIOD} s\n"
            "# heights [m] are displacements from the table's rest height, velocities in m/s\n"
        )
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for each in lifts:
            for time, row in zip(each.times, each.series, strict=True):
                values = (f"{value:.{DIGITS}f}" for value in row)
                writer.writerow((each.lift, each.behaviour, each.subject, f"{time:g}", *values))


def read_demonstrations(path: Path) -> tuple[Demonstration, ...]:
    """Return the demonstrations of a file.

    Raises
    ------
    InputError
        If the file cannot be read, a column is missing, a value is not a number, or the samples of
        a lift are not evenly spaced in time; the message states the place.
    """
    lifts: dict[tuple[str, ...], list[list[float]]] = {}
    for name, row in _rows(path):
        lifts.setdefault(name, []).append(row)
    if not lifts:
        raise InputError(f"{path}: no samples, needs rows of {','.join(COLUMNS)}")
    found = []
    for (lift, behaviour, subject), rows in lifts.items():
        table = np.array(rows)
        gaps = np.diff(table[:, 0])
        if not len(gaps) or gaps.min() <= 0 or gaps.max() - gaps.min() > 0.1 * gaps.mean():
            raise InputError(f"{path}: the samples of lift {lift} are not evenly spaced in time")
        found.append(
            Demonstration(
                lift=int(lift),
                behaviour=behaviour,
                subject=subject,
                times=table[:, 0],
                series=table[:, 1:],
            )
        )
    return tuple(found)


def _rows(path: Path) -> Iterator[tuple[tuple[str, ...], list[float]]]:
    """Yield the words and the numbers of each row."""
    text = decoded(read_bytes(path, LARGEST), str(path))
    lines = text.splitlines(keepends=True)
    comments = len(list(itertools.takewhile(lambda line: line.startswith("#"), lines)))
    reader = csv.DictReader(lines[comments:])
    missing = set(COLUMNS) - set(reader.fieldnames or ())
    if missing:
        raise InputError(f"{path}: missing column(s) {', '.join(sorted(missing))}")
    for row in reader:
        yield _row(row, f"{path}, line {comments + reader.line_num}")


def _row(row: dict[str, str], where: str) -> tuple[tuple[str, ...], list[float]]:
    words, numbers = COLUMNS[:3], COLUMNS[3:]
    if not str(row["lift"]).isdecimal():
        raise InputError(f"{where}: lift is {row['lift']!r}, must be a whole number")
    values = []
    for column in numbers:
        try:
            values.append(float(row[column]))
        except (TypeError, ValueError):
            values.append(math.nan)
        if not math.isfinite(values[-1]):
            raise InputError(f"{where}: {column} is {row[column]!r}, must be a finite number")
    return tuple(row[word] for word in words), values
