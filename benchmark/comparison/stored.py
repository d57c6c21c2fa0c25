"""Results of policies that were played before: in bundles, or by an evaluation."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from colift.base.errors import InputError
from colift.base.registry import POLICIES, entries
from colift.benchmark.bundle.files import RESULTS, is_bundle
from colift.benchmark.bundle.json_text import pick
from colift.benchmark.bundle.present import read_present
from colift.benchmark.channels import Channel, channel_name
from colift.benchmark.comparison.paired_results import PolicyResults
from colift.benchmark.results.summary import StepTimes
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True, eq=False)
class Stored:
    """Scores of a policy and their suite; those of a bundle as it claims them."""

    origin: str
    """The folder of the bundle, or the evaluation, in words."""
    policy: PolicyResults
    suite: Suite
    channel: Channel | None
    """The channel between the robot and the policy; None if there was none."""
    vs_human: Estimate | None
    """Ratio to the human-human baseline; None without this baseline."""


def read_stored(folder: Path) -> Stored:
    """Return the scores in a bundle.

    Raises
    ------
    InputError
        If there is none, it is damaged or incomplete, or its scores are not those of this version
        of colift.
    """
    bundle, run = read_present(folder)
    content = bundle.results
    if not (content["complete"] and run.complete):
        raise InputError(
            f"{folder} has {len(run.episodes)} of {run.suite.size} lifts: run the rest"
        )
    step = content["summary"]["step_ms"]
    policy = PolicyResults.of(run.policy, run)
    policy = dataclasses.replace(policy, step_ms=StepTimes(p50=step["p50"], p99=step["p99"]))
    return Stored(
        origin=str(folder),
        policy=policy,
        suite=run.suite,
        channel=run.channel,
        vs_human=_vs_human(content),
    )


def stored_among(texts: Iterable[str]) -> dict[str, Stored]:
    """Return the results of the bundles among what a user has named, by their folders."""
    return {
        text: read_stored(Path(text))
        for text in texts
        if text not in entries(POLICIES) and is_bundle(Path(text))
    }


def _vs_human(content: Mapping[str, Any]) -> Estimate | None:
    if pick(content, "summary.vs_human", (dict, type(None)), RESULTS) is None:
        return None
    mean = pick(content, "summary.vs_human.mean", float, RESULTS)
    match pick(content, "summary.vs_human.ci95", (list, type(None)), RESULTS):
        case None:
            return Estimate(mean=mean, ci95=None)
        case [float(low), float(high)]:
            return Estimate(mean=mean, ci95=(low, high))
    raise InputError(f"{RESULTS}: summary.vs_human.ci95 must be two numbers, or null")


def check_same_lifts(stored: Sequence[Stored], suite: Suite, channel: Channel | None) -> None:
    """Raise an InputError if results are of other lifts than a suite's, or over another channel."""
    for each in stored:
        if each.channel != channel:
            raise InputError(
                f"{each.origin} was played over {_shown(each.channel)}, not over "
                f"{_shown(channel)}: policies are compared over the same channel"
            )
        if each.suite.digest != suite.digest:
            raise InputError(
                f"{each.origin} has the lifts of {each.suite.name} (digest {each.suite.digest}), "
                f"not of {suite.name} (digest {suite.digest}): policies are compared on the same "
                "lifts"
            )


def _shown(channel: Channel | None) -> str:
    return "no channel" if channel is None else f"the channel {channel_name(channel)}"
