"""The validity of suites on sources of real lifts, in sentences and as JSON."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from typing import Any, Final

from colift.base.errors import InputError
from colift.benchmark.validity.beside_pairs import BesidePairs
from colift.benchmark.validity.prediction import SuitePrediction, predict
from colift.benchmark.validity.scores import Scores
from colift.benchmark.validity.verdict import SuiteVerdict, judge, order_text, people_text
from colift.benchmark.validity.winner import best_shares

FEWEST_POLICIES: Final = 4
"""Fewest policies for an order: of three policies, one order in six agrees by chance, of four, one
in 24."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SuiteOnSource:
    """A suite's prediction of a source."""

    suite: Scores
    prediction: SuitePrediction
    verdict: SuiteVerdict

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on the order and on two people, where the suite disagrees with the source."""
        found = (
            order_text(self.suite.name, self.prediction),
            people_text(self.verdict.source, self.suite.name, self.prediction),
        )
        return tuple(filter(None, found))

    @property
    def text(self) -> str:
        """The verdict on this suite alone, with its notes."""
        return " ".join((self.verdict.text([self.suite.name]), *self.notes))


@dataclass(frozen=True, kw_only=True, eq=False)
class SourceValidity:
    """The validity of all suites on a source."""

    source: Scores
    kind: str
    best_shares: Mapping[str, float]
    """Share of the resamples in which each policy is the best; see :func:`.best_shares`."""
    suites: tuple[SuiteOnSource, ...]

    @property
    def winner(self) -> str:
        """The policy with the lowest mean RMSE on the source."""
        return self.source.order()[0]

    @property
    def texts(self) -> tuple[str, ...]:
        """The verdicts in sentences: one for all suites with the same best policy, then others."""
        by_policy: dict[str, list[SuiteOnSource]] = {}
        for each in self.suites:
            by_policy.setdefault(each.verdict.policy, []).append(each)
        names = ([each.suite.name for each in some] for some in by_policy.values())
        verdicts = (some[0].verdict for some in by_policy.values())
        first = [verdict.text(some) for verdict, some in zip(verdicts, names, strict=True)]
        return (*first, *(note for each in self.suites for note in each.notes))


@dataclass(frozen=True, kw_only=True, eq=False)
class Validity:
    """The validity of suites on sources, by source."""

    sources: tuple[SourceValidity, ...]
    suites: tuple[Scores, ...]

    @property
    def policies(self) -> tuple[str, ...]:
        """The policies, in the order of the first suite, the best first."""
        return self.suites[0].order()


def check_policies(names: Sequence[str]) -> None:
    """Refuse policies that are too few for an order.

    Raises
    ------
    InputError
        If there are fewer than :data:`FEWEST_POLICIES`.
    """
    if len(names) < FEWEST_POLICIES:
        raise InputError(
            f"validity needs {FEWEST_POLICIES} policies or more, got {len(names)}: the order of "
            "fewer agrees too often by chance"
        )


def validity_of(sources: Sequence[tuple[str, Scores]], suites: Sequence[Scores]) -> Validity:
    """Return the validity of suites.

    Parameters
    ----------
    sources
        Kind and scores of each source.
    suites
        Scores on each suite, of the same policies in the same order.

    Raises
    ------
    InputError
        If there are fewer than :data:`FEWEST_POLICIES` policies.
    """
    check_policies(suites[0].policies)
    return Validity(
        sources=tuple(
            SourceValidity(
                source=source,
                kind=kind,
                best_shares=best_shares(source),
                suites=tuple(_on_source(source, suite) for suite in suites),
            )
            for kind, source in sources
        ),
        suites=tuple(suites),
    )


def _on_source(source: Scores, suite: Scores) -> SuiteOnSource:
    return SuiteOnSource(
        suite=suite, prediction=predict(source, suite), verdict=judge(source, suite)
    )


def validity_json(validity: Validity) -> dict[str, Any]:
    """Return the content of ``colift validity --json``.

    Every number with an interval is ``value``, ``low`` and ``high``. The fields of a suite on a
    source are those of :class:`.SuitePrediction`, and :class:`.SuiteVerdict` as ``verdict``.
    """
    return {
        "colift": version("colift"),
        "policies": list(validity.policies),
        "sources": [_source(each) for each in validity.sources],
        "suites": [
            {**_lifts(suite), "shipped": list(suite.shipped), "policies": _policies(suite)}
            for suite in validity.suites
        ],
    }


def _source(each: SourceValidity) -> dict[str, Any]:
    beside = each.source.beside
    return {
        **_lifts(each.source),
        "kind": each.kind,
        **({} if beside is None else {"recorded_pairs": _beside(beside)}),
        "winner": {"policy": each.winner, "best_share": each.best_shares[each.winner]},
        "policies": [
            {**policy, "best_share": each.best_shares[policy["name"]]}
            for policy in _policies(each.source)
        ],
        "suites": [_suite(suite) for suite in each.suites],
    }


def _suite(each: SuiteOnSource) -> dict[str, Any]:
    found, verdict = each.prediction, each.verdict
    return {
        "name": each.suite.name,
        "spearman": asdict(found.spearman),
        "kendall": asdict(found.kendall),
        "kendall_best_half": asdict(found.kendall_best_half),
        "better_than_two_people": None if found.better is None else asdict(found.better),
        "ratio": {
            "factor": asdict(found.factor),
            "bias": asdict(found.bias),
            "fall_behind": list(found.fall_behind),
            "overtake": list(found.overtake),
        },
        "winner": {"policy": verdict.policy, "place": verdict.place},
        "verdict": {
            "judgement": verdict.judgement,
            "rival": asdict(verdict.rival),
            "beaten_by": [rival.name for rival in verdict.beaten_by],
            "text": each.text,
        },
    }


def _lifts(scores: Scores) -> dict[str, Any]:
    return {
        "name": scores.name,
        "digest": scores.digest,
        "lifts": scores.lifts,
        "human_human_rmse_mm": asdict(scores.human_human_mm),
    }


def _beside(beside: BesidePairs) -> dict[str, Any]:
    """Return the RMSE of the recorded pairs, and the ratios to it, of two simulated people, too."""
    return {
        "lifts": len(beside.pairs),
        "rmse_mm": asdict(beside.pairs_mm),
        "ratios": {name: asdict(beside.ratio(name)) for name in beside.errors},
    }


def _policies(scores: Scores) -> list[dict[str, Any]]:
    return [
        {
            "name": name,
            "place": place,
            "rmse_mm": asdict(scores.mean_mm(name)),
            "vs_human": asdict(scores.vs_human(name)),
            "failed": scores.failed.get(name, 0),
        }
        for place, name in enumerate(scores.order(), 1)
    ]
