"""A row of a board: all that is published of an evaluation, beside the public run's bundle."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, Self

from ...benchmark.statistics import Estimate, MeanWithMissing
from .metrics import read_means

UNTRAINED: Final = ("nothing", "none", "no data")
"""What authors write of a policy that was trained on nothing."""


@dataclass(frozen=True, kw_only=True)
class PublicScores:
    """What a policy did on the public episodes."""

    episodes: int
    failed: int
    """Episodes that failed; they count with the worst error."""
    rmse_mm: Estimate
    vs_human: Estimate
    """RMSE over that of the human-human team: 1 is as good as a human partner, less is better."""
    metrics: Mapping[str, MeanWithMissing]
    """The other metrics of a board by name; see :func:`.board_metrics`."""
    step_ms_p50: float | None
    """Median time of a step of the policy [ms]; nothing if it never made one."""
    step_ms_p99: float | None
    """The same, 99th percentile."""
    real_time: bool | None
    """Whether that is within what a real robot waits for; nothing if it never made a step."""


@dataclass(frozen=True, kw_only=True)
class HiddenScores:
    """What a policy did on the hidden episodes: no more than this is told of them.

    Rounded, so that a policy cannot write what it has seen into the digits of its score.
    """

    episodes: int
    failed: int
    failures: Mapping[str, int]
    """How many failed how: at the ``start``, in a ``step`` of its own, or the ``table`` was lost.
    In no words of the policy's."""
    rmse_mm: Estimate
    vs_human: Estimate
    real_time: bool | None
    """Whether it kept pace there as well."""
    better_than_human: float
    """Probability that its mean RMSE on such episodes is below the human-human team's."""


@dataclass(frozen=True, kw_only=True)
class BoardRow:
    """A policy's place in the table of a season."""

    season: str
    commitment: str
    """SHA-256 of the season's secret."""
    suite: str
    suite_digest: str
    name: str
    authors: tuple[str, ...]
    description: str
    link: str
    licence: str
    """What others may do with it, in its authors' words."""
    trained_on: str
    """What data it was trained on, in its authors' words; ``nothing`` is an answer."""
    submission: str
    """Digest of the submission's content."""
    public: PublicScores
    hidden: HiddenScores
    gap_mm: Estimate
    """Hidden minus public mean RMSE [mm]. Other people lift there, so the gap of an honest policy
    is not zero, but like everybody's."""
    isolation: str
    """What kept the policy from the process that scored."""
    verified: bool
    """Whether the policy was isolated, its sampled episodes were repeated bit for bit, and the
    public scores follow from the recorded actions."""
    scoring: int
    """Version of the metrics."""
    versions: Mapping[str, str]
    """Of the packages that can change a number."""

    @property
    def learned(self) -> bool:
        """Whether its authors say that it was trained on something."""
        return self.trained_on.strip(" .").casefold() not in UNTRAINED

    @property
    def real_time(self) -> bool:
        """Whether it kept pace with a robot, in public and in hidden episodes.

        Who never made a step was not too slow.
        """
        return False not in (self.public.real_time, self.hidden.real_time)

    def plain(self) -> dict[str, Any]:
        """Return the row as JSON has it."""
        return dataclasses.asdict(self)

    @classmethod
    def read(cls, content: Mapping[str, Any]) -> Self:
        """Return the row that :meth:`plain` has written."""
        public, hidden = content["public"], content["hidden"]
        return cls(
            **{
                **content,
                "authors": tuple(content["authors"]),
                "gap_mm": _estimate(content["gap_mm"]),
                "public": PublicScores(
                    **{**public, **_estimates(public), "metrics": read_means(public["metrics"])}
                ),
                "hidden": HiddenScores(**{**hidden, **_estimates(hidden)}),
            }
        )


def _estimates(scores: Mapping[str, Any]) -> dict[str, Estimate]:
    return {name: _estimate(scores[name]) for name in ("rmse_mm", "vs_human")}


def _estimate(content: Mapping[str, Any]) -> Estimate:
    low, high = content["ci95"]
    return Estimate(mean=content["mean"], ci95=(low, high))
