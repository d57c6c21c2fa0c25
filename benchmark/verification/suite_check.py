"""The check of what was played: the suite, and which episodes of it are there."""

from collections.abc import Iterator

from ..bundle import Bundle, one_line
from ..bundle.files import EPISODES, MANIFEST, RESULTS, TRACES
from ..episode import Episode
from ..scores import SCORING
from ..suite import SUITES, Suite, make_suite
from .verdict import Finding


def suite_findings(bundle: Bundle, suite: Suite) -> Iterator[Finding]:
    """Yield what is wrong with the names and digests of the suite that the recipe makes."""
    claimed, digest = bundle.results["suite_digest"], suite.digest
    # The constants of the metrics are in the digest: those of older scores may have been others.
    if claimed != digest and bundle.results["scoring"] == SCORING:
        message = (
            f"suite_digest is {claimed!r:.80}, but {MANIFEST} makes a suite of digest {digest!r}: "
            "other episodes, or the benchmark's rules have changed since"
        )
        yield Finding(file=RESULTS, message=message)
    if bundle.results["suite"] != suite.name:
        message = f"suite is {bundle.results['suite']!r:.80}, in {MANIFEST} {suite.name!r:.80}"
        yield Finding(file=RESULTS, message=message)
    if suite.name in SUITES and digest != make_suite(suite.name).digest:
        message = f"its episodes are not those of {suite.name}, whose name it has"
        yield Finding(file=MANIFEST, message=message)


def episode_findings(bundle: Bundle, suite: Suite) -> Iterator[Finding]:
    """Yield the first episode that is not what the suite has at its place, and the first missing.

    An incomplete run is wrong in any case: there is no score on part of a suite.
    """
    names = [
        _name(scene.behaviour, scene.subject.name, scene.trial, seed)
        for scene in suite.scenarios
        for seed in suite.seeds
    ]
    for row, (place, episode) in enumerate(zip(bundle.places, bundle.episodes, strict=True), 1):
        found = episode_name(episode)
        if found != names[place]:
            message = f"row {row} is {found} instead"
            yield Finding(file=EPISODES, episode=names[place], message=message)
            break
    missing = sorted({*range(suite.size)} - {*bundle.places})
    if missing:
        message = (
            f"missing, one of {len(missing)} of {suite.size} episodes: part of a suite has no "
            "score; finish the run with colift run --resume"
        )
        yield Finding(file=TRACES, episode=names[missing[0]], message=message)


def episode_name(episode: Episode) -> str:
    """Return the name of an episode, such as ``pause/S3 seed 4``."""
    return _name(episode.behaviour, episode.subject, episode.trial, episode.seed)


def _name(behaviour: str, subject: str, trial: str, seed: int) -> str:
    return f"{one_line('/'.join(filter(None, (behaviour, subject, trial))))} seed {seed}"
