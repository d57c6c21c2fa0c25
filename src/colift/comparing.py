"""``colift.compare``: policies on the same lifts, by one call."""

from contextlib import nullcontext
from pathlib import Path

from colift.agents.agent import Agent
from colift.agents.spec import AUTO, AgentSpec
from colift.base.errors import InputError
from colift.base.registry import check_plays
from colift.benchmark.channels import Channel
from colift.benchmark.comparison.compare import compare as compared
from colift.benchmark.comparison.entrants import named_apart
from colift.benchmark.comparison.paired_results import PolicyResults
from colift.benchmark.comparison.playing import episodes_to_play, play_policies
from colift.benchmark.comparison.stored import Stored, check_same_lifts, stored_among
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.suites.suite import Suite, make_suite
from colift.comparison import Comparison
from colift.evaluation import DEFAULT_SUITE, chosen_channel, policy_spec
from colift.outcome import Evaluation

__all__ = ["Comparison", "compare"]

Entrant = Agent | type[Agent] | str | Path | Evaluation
"""A policy as for :func:`.evaluate`, the folder of a result bundle, or an evaluation."""


def compare(
    *policies: Entrant,
    suite: str | Suite | None = None,
    channel: str | Path | Channel | None = None,
    references: bool = False,
    isolation: str = AUTO,
    jobs: int = 1,
    progress: bool = False,
) -> Comparison:
    """Compare policies on the same lifts: ranks, paired differences, intervals.

    Parameters
    ----------
    policies
        At least two: policies as for :func:`.evaluate`, result bundles of ``colift run --out`` by
        their folders, and evaluations. The last two are not simulated again.
    suite
        A name of :func:`.list_suites`, or a suite; by default that of the bundles and evaluations,
        else ``"quick-v1"``.
    channel
        The network between the robot and every policy; by default that of the bundles and
        evaluations.
    references
        Whether to play the references, such as the oracle; shipped ones are always shown.
    isolation, jobs, progress
        As for :func:`.evaluate`.

    Returns
    -------
    Comparison
        The comparison: ``print`` shows its tables, a notebook also a picture.

    Raises
    ------
    InputError
        If there are fewer than two policies, one cannot be used, or results are of other lifts or
        over another channel than the others.
    EvaluatorFault
        If the machine, not a policy, fails repeatedly.
    KeyboardInterrupt
        After Ctrl-C: policies are compared on all lifts or not at all.
    """
    if len(policies) < 2:
        raise InputError(f"name at least two policies to compare, got {len(policies)}")
    specs, stored = _entrants(policies, isolation, jobs)
    played = _suite(suite, stored)
    task = played.scenarios[0].task.name
    for each in policies:
        if isinstance(each, str | Path):
            check_plays(str(each), task)
    network = chosen_channel(channel)
    if network is None and stored:
        network = stored[0].channel
    check_same_lifts(stored, played, network)
    for spec in specs.values():
        check_fits(spec, played.scenarios[0], played.seeds[0])
    limits = suite_references(played) if references else {}
    total = episodes_to_play(len(specs), played, references=len(limits))
    bar = progress_bar("compare", total) if progress else nullcontext(lambda done: None)
    with bar as advance, local_pool(jobs) as pool:
        results = play_policies(
            specs,
            played,
            stored=[each.policy for each in stored],
            references=limits,
            executor=pool,
            progress=advance,
            channel=network,
        )
    return Comparison(content=compared(results))


def _suite(suite: str | Suite | None, stored: list[Stored]) -> Suite:
    """Return the suite of a comparison."""
    if isinstance(suite, Suite):
        return suite
    if suite is None and stored:
        return stored[0].suite
    return make_suite(suite or DEFAULT_SUITE)


def _entrants(
    policies: tuple[Entrant, ...], isolation: str, jobs: int
) -> tuple[dict[str, AgentSpec], list[Stored]]:
    """Return the policies to play, by the names that tables use, and the results of the others."""
    specs: dict[str, AgentSpec] = {}
    stored: dict[str, Stored] = {}
    for place, each in enumerate(policies, 1):
        text = str(each) if isinstance(each, str | Path) else f"{_name(each)} ({place})"
        if text in specs or text in stored:
            raise InputError(f"policy {text} is named twice; name each policy once")
        if isinstance(each, Evaluation):
            stored[text] = _evaluated(each)
        elif isinstance(each, str | Path) and (bundle := stored_among([text])):
            stored |= bundle
        else:
            specs[text] = policy_spec(each, isolation, jobs)
    return named_apart(specs, stored)


def _name(policy: object) -> str:
    """Return the name of a policy that is not given as text."""
    if isinstance(policy, Evaluation):
        return policy.run.policy
    return policy.__name__ if isinstance(policy, type) else type(policy).__name__


def _evaluated(evaluation: Evaluation) -> Stored:
    run = evaluation.run
    if not run.complete:
        raise InputError(
            f"the evaluation of {run.policy} has {len(run.episodes)} of {run.suite.size} lifts: "
            "run the rest"
        )
    return Stored(
        origin=f"the evaluation of {run.policy}",
        policy=PolicyResults.of(run.policy, run),
        suite=run.suite,
        channel=run.channel,
        vs_human=evaluation.results.summary.vs_human,
    )
