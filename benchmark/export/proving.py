"""The lifts of a bundle with observations, each proved: its replay gives the bundle's hashes."""

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass

from colift.base.errors import InputError
from colift.benchmark.bundle import Bundle, one_line
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.replay import ReplayError, replay
from colift.benchmark.execution.provenance import POLICIES_ONLY, fingerprint
from colift.benchmark.export.lifts import ExportedLift
from colift.benchmark.export.observing import ObservedLift
from colift.benchmark.suites.suite import Due, Suite, alike
from colift.benchmark.verification.deviation import first_difference
from colift.benchmark.verification.episode_check import episode_checks


@dataclass(frozen=True, kw_only=True, eq=False)
class Proof:
    """Some lifts of a suite, to be replayed."""

    lifts: tuple[Due, ...]
    episodes: tuple[Episode, ...]
    """The claimed episodes of these lifts."""
    policy: str
    """Name of the bundle's policy."""
    both: bool
    """Whether the human's part is kept."""

    def __call__(self) -> list[ExportedLift]:
        """Return the lifts; worker processes run this.

        Raises
        ------
        InputError
            If a replay differs from the bundle in a bit.
        """
        claims, proved = iter(self.episodes), []
        for scenario, some in alike(self.lifts):
            with closing(ObservedLift(scenario, both=self.both)) as lift:
                proved += [self._proved(lift, due.seed, next(claims)) for due in some]
        return proved

    def _proved(self, lift: ObservedLift, seed: int, claim: Episode) -> ExportedLift:
        logged = claim.trace
        try:
            found = replay(lift, seed, logged.human_action, logged.action, claim.failure)
        except ReplayError as error:
            raise _refused(lift, seed, error.step, error.message) from None
        difference = first_difference(logged, found)
        if difference is not None:
            raise _refused(lift, seed, *difference)
        if found.failure != claim.failure:
            message = f"failure says {claim.failure!r}, the replay gives {found.failure!r}"
            raise _refused(lift, seed, len(logged.action), message)
        last = logged.state[-1].tobytes() if len(logged.state) else b""
        return lift.exported(self.policy, found.failure, last)


def _refused(lift: ObservedLift, seed: int, step: int, message: str) -> InputError:
    name = one_line(f"{lift.scenario.name} seed {seed}")
    return InputError(f"{name}, step {step}: {message}; a lift that is not proved is not exported")


def proved_lifts(
    bundle: Bundle,
    suite: Suite,
    *,
    both: bool = False,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> Iterator[ExportedLift]:
    """Yield the lifts of a bundle in its order, with the agents' observations.

    Observations and rewards are in no bundle: they follow from the actions by replay, which also
    proves each lift.

    Parameters
    ----------
    bundle
        The bundle; nothing in it is trusted.
    suite
        Its suite.
    both
        Whether the human's part is kept.
    executor
        Replays the lifts; None replays them in this process.
    progress
        Called with the number of lifts that were replayed since the last call.

    Raises
    ------
    InputError
        If the suite differs from that of this colift, or a replay differs from the bundle in a bit;
        the message names the lift, the step and the difference.
    """
    claimed = bundle.results["suite_digest"]
    if suite.digest != claimed:
        raise InputError(
            f"results.json: suite_digest is {claimed}, in this colift {suite.name} has "
            f"{suite.digest}: export the bundle with colift {bundle.results['colift']}"
        )
    proofs = [
        Proof(
            lifts=check.lifts,
            episodes=check.episodes,
            policy=one_line(bundle.results["policy"]["name"]),
            both=both,
        )
        for check in episode_checks(bundle, suite, same_platform=True)
    ]
    parts = map(_called, proofs) if executor is None else executor.map(_called, proofs)
    try:
        for part in parts:
            progress(len(part))
            yield from part
    except InputError as error:
        other = _other_platform(bundle)
        if not other:
            raise
        raise InputError(
            f"{error}. The bundle is from another platform ({other}): export it there"
        ) from None


def _called(proof: Proof) -> list[ExportedLift]:
    return proof()


def _other_platform(bundle: Bundle) -> str:
    """Return the names of the differences between the bundle's platform and this one."""
    there, here = bundle.platform, fingerprint()
    differ = {name for name in {**here, **there} if there.get(name) != here.get(name)}
    return one_line(", ".join(sorted(differ - set(POLICIES_ONLY))))
