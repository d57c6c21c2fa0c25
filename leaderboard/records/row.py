"""A row of a board: the published results of an evaluation, apart from the public run's bundle."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, Self

import msgspec
from colift.benchmark.statistics import Estimate, MeanWithMissing
from colift.leaderboard.records.metrics import board_metrics, read_means

UNTRAINED: Final = ("nothing", "none", "no data")
"""Entries of ``trained_on`` that stand for a policy without training."""


@dataclass(frozen=True, kw_only=True)
class PublicScores:
    """Scores on the public episodes."""

    episodes: int
    """Episodes played."""
    failed: int
    """Episodes that failed; they count with the worst error."""
    rmse_mm: Estimate
    """Mean RMSE [mm]."""
    vs_human: Estimate
    """Ratio of the RMSE to two people's, geometric mean over the lifts: 1 is as good
    as a human partner."""
    metrics: Mapping[str, MeanWithMissing]
    """The other metrics of a board by name; see :func:`.board_metrics`."""
    step_ms_p50: float | None
    """Median time of the policy's steps [ms]; None without a step."""
    step_ms_p99: float | None
    """The same, 99th percentile."""
    real_time: bool | None
    """Whether that is within the time that a real robot waits; None without a step."""


@dataclass(frozen=True, kw_only=True)
class HiddenScores:
    """Published scores on the hidden episodes.

    They are rounded: a policy cannot encode what it has seen in the digits of its score.
    """

    episodes: int
    """Episodes played."""
    failed: int
    """Episodes that failed; they count with the worst error."""
    failures: Mapping[str, int]
    """Failures by kind: at the ``start``, in a ``step`` of the policy, or the ``table`` was lost.
    Messages of the policy are not published."""
    rmse_mm: Estimate
    """Mean RMSE [mm]."""
    vs_human: Estimate
    """The same ratio as on the public episodes."""
    real_time: bool | None
    """The same as for the public episodes."""
    better_than_human: float | None
    """Probability that ``vs_human`` is below 1 with other people; None if all are of one person."""
    rougher: tuple[str, ...] | None = None
    """Names of the metrics by which it is rougher than two people; None in a row of a season in
    which this was not known."""


@dataclass(frozen=True, kw_only=True)
class BoardRow:
    """A policy's results in a season."""

    season: str
    """Name of the season."""
    commitment: str
    """SHA-256 of the season's secret."""
    suite: str
    """Name of the public suite."""
    suite_digest: str
    """Digest of the public suite."""
    name: str
    """Name of the policy."""
    authors: tuple[str, ...]
    """Names of its authors."""
    description: str
    """Description, in its authors' words."""
    link: str
    """Address of a page with more information; may be empty."""
    licence: str
    """Licence, in its authors' words."""
    trained_on: str
    """Training data, in its authors' words; may be ``nothing``."""
    submission: str
    """Digest of the submission's content."""
    public: PublicScores
    """Scores on the public episodes."""
    hidden: HiddenScores
    """Scores on the hidden episodes."""
    gap: Estimate
    """``vs_human`` on the hidden episodes over that on the public ones: near 1 for an honest
    policy, since each is relative to two people on the same lifts."""
    isolation: str
    """Isolation level of the policy."""
    verified: bool
    """Whether the policy was isolated, its sampled episodes were repeated bit for bit, and the
    public scores follow from the recorded actions."""
    scoring: int
    """Version of the metrics."""
    versions: Mapping[str, str]
    """Versions of the packages that can change a number."""

    @property
    def learned(self) -> bool:
        """Whether its authors name training data."""
        return self.trained_on.strip(" .").casefold() not in UNTRAINED

    @property
    def real_time(self) -> bool:
        """Whether it was real-time in public and hidden episodes; True without a step."""
        return False not in (self.public.real_time, self.hidden.real_time)

    def plain(self) -> dict[str, Any]:
        """Return the row as JSON."""
        return dataclasses.asdict(self)

    @classmethod
    def read(cls, content: Mapping[str, Any]) -> Self:
        """Return the row from the output of :meth:`plain`.

        Raises
        ------
        msgspec.ValidationError
            If a part is missing or of another type.
        """
        row = msgspec.convert(content, cls)
        public = row.public
        if set(public.metrics) == {metric.name for metric in board_metrics(row.suite)}:
            return row
        means = read_means(content["public"]["metrics"], row.suite, public.episodes)
        return dataclasses.replace(row, public=dataclasses.replace(public, metrics=means))
