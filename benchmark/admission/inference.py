"""The admission of a suite with conditions: whether there is something to infer.

A suite whose lifts are drawn under conditions does not claim that its lifts need coordination, but
that a robot has to find out what it is not told. Networks of one kind and one budget show it.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from typing import Final

from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import INFERENCE, Criterion
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.ratio import ratio_criterion
from colift.benchmark.references.oracle import ORACLE, oracle_run
from colift.benchmark.references.told import play_told
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.robust.telling import is_conditioned
from colift.benchmark.training.told_network import ToldNetwork
from colift.benchmark.training.variants import TOLD_BOTH, UNTOLD, USUAL

SPECIALIST: Final = 1.3
"""Least error of a network that knows one delay, over that of one trained on the suite's."""

KNOWING: Final = 0.87
"""Largest error of a network that is told, over that of one that is not."""


def needs_inference(suite: Suite) -> bool:
    """Return whether it is inference that a suite claims to need: all of its lifts are drawn."""
    return all(map(is_conditioned, suite.scenarios))


def lifts_to_play(suite: Suite, networks: int) -> int:
    """Return the number of lifts of :func:`inference_of`."""
    return (networks + 2) * suite.size


def inference_of(
    suite: Suite,
    networks: Mapping[str, ToldNetwork],
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Admission:
    """Test a suite with conditions.

    Parameters
    ----------
    suite
        The suite.
    networks
        The trained networks by name.
    executor, progress
        As for :func:`.run_suite`.

    Raises
    ------
    InputError
        If the suite has no conditions, or too few people or lifts of each.
    """
    human_human = human_human_run(suite, executor=executor, progress=progress)
    oracle = oracle_run(suite, executor=executor, progress=progress)
    tables = {HUMAN_HUMAN_LABEL: ScoreTable.of(human_human), ORACLE: ScoreTable.of(oracle)}
    for name, network in networks.items():
        run = play_told(network, suite, name, executor=executor, progress=progress)
        tables[name] = ScoreTable.of(run)
    played = Played.of(tables)
    return Admission(
        suite=suite.name,
        digest=suite.digest,
        means=played.means,
        criteria=(
            ratio_criterion(
                played,
                USUAL,
                UNTOLD,
                Criterion(
                    letter="a",
                    claim=INFERENCE,
                    what="one delay is not enough: error of a network that knows no other, over "
                    "that of one trained on the suite's",
                    bar=f"at least {SPECIALIST:g}",
                    detail="",
                ),
                least=SPECIALIST,
            ),
            ratio_criterion(
                played,
                TOLD_BOTH,
                UNTOLD,
                Criterion(
                    letter="b",
                    claim=INFERENCE,
                    what="there is something to infer: error of a network that is told latency and "
                    "habits, over that of one that is told nothing",
                    bar=f"at most {KNOWING:g}",
                    detail="",
                ),
                most=KNOWING,
            ),
        ),
        control=None,
    )
