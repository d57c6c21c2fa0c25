"""Some lifts of a bundle, simulated again from their actions, to be shown."""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from colift.benchmark.bundle import Bundle, differences
from colift.benchmark.bundle.files import EPISODES
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.verification.content_check import episode_name
from colift.benchmark.verification.deviation import SCORES
from colift.benchmark.verification.episode_check import Checked, simulate
from colift.benchmark.verification.verdict import Finding
from colift.benchmark.verification.verify import is_same, other_platform


@dataclass(frozen=True, kw_only=True, eq=False)
class ReplayedLift:
    """A lift of a bundle."""

    episode: Episode
    """As recorded, with the scores that follow from its actions, if any do."""
    scenario: Scenario
    findings: tuple[Finding, ...]
    """What does not follow from the actions; empty if everything does."""


def replayed_lifts(bundle: Bundle, suite: Suite, rows: Sequence[int]) -> Iterator[ReplayedLift]:
    """Yield the lifts of a bundle in some rows, each simulated again without the policy.

    Raises
    ------
    InputError
        If the task or the behaviour of another package failed.
    """
    same_platform = is_same(other_platform(bundle))
    for row in rows:
        episode, index = bundle.episodes[row], bundle.indices[row]
        (checked,) = simulate(
            bundle,
            suite,
            [row],
            same_platform=same_platform,
            executor=None,
            progress=lambda done: None,
        )
        exact = same_platform or checked.bit_equal
        yield ReplayedLift(
            episode=episode
            if checked.scores is None
            else dataclasses.replace(episode, scores=checked.scores, failure=checked.failure),
            scenario=suite.at(index).scenario,
            findings=tuple(_findings(episode, checked, exact=exact)),
        )


def _findings(claim: Episode, checked: Checked, *, exact: bool) -> Iterator[Finding]:
    if checked.finding is not None:
        yield checked.finding
    if checked.scores is not None:
        scores = (dict(each) for each in (claim.scores, checked.scores))
        for difference in differences(*scores, tolerance=0.0 if exact else SCORES):
            yield Finding(file=EPISODES, episode=episode_name(claim), message=str(difference))
