"""``colift.evaluate``: a policy's scores on a suite, by one call."""

import inspect
import textwrap
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from colift.agents.agent import Agent
from colift.agents.loading.policy_spec import source_digest
from colift.agents.spec import AUTO, NONE, AgentSpec, InProcess
from colift.agents.submissions.choice import choose_policy
from colift.base.errors import InputError
from colift.base.identity import source_hash
from colift.benchmark.bundle import results
from colift.benchmark.channels import Channel, make_channel
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import BASELINES, play_baselines, shipped_baselines
from colift.benchmark.suites.suite import Suite, make_suite
from colift.outcome import Evaluation

DEFAULT_SUITE = "quick-v1"
"""The suite of one lift with each of three people on each behaviour."""

UNKNOWN = "unknown"
"""The digest of a policy whose source cannot be read, such as one typed at a prompt."""


@dataclass(frozen=True, kw_only=True)
class GivenPolicy(InProcess):
    """A policy given as an object or a class: it acts in this process."""

    given: object
    """An object with ``reset`` and ``act``, or a class of such objects."""

    @property
    def type(self) -> type:
        """The policy's class."""
        return self.given if isinstance(self.given, type) else type(self.given)

    @property
    def name(self) -> str:
        """The name of the class."""
        return self.type.__name__

    def check(self) -> None:
        """Raise an InputError if it has no ``reset`` or ``act``, or the class needs arguments."""
        for method in ("reset", "act"):
            if not callable(getattr(self.given, method, None)):
                raise InputError(
                    f"policy {self.given!r} has no method {method}(): give an object or a class "
                    "with reset(seed) and act(observation), or a name of colift.list_policies()"
                )
        if isinstance(self.given, type):
            try:
                inspect.signature(self.given).bind()
            except TypeError as error:
                raise InputError(
                    f"policy {self.name} cannot be made without arguments ({error}): give an object"
                ) from error

    def digest(self) -> str:
        """Return the hash of the source of the class, or :data:`UNKNOWN`.

        It is that of ``file.py:Class``, over all that the file defines; of a class without a file,
        as in a notebook, over the class alone. The arguments and the learned state of an object
        are not part of it.
        """
        try:
            file = inspect.getsourcefile(self.type)
            if file is not None and Path(file).is_file():
                return source_digest(self.type)
            source = inspect.getsource(self.type)
        except (OSError, TypeError):
            return UNKNOWN
        return source_hash(textwrap.dedent(source).encode())

    def make(self) -> Agent:
        """Return the object, or a new one of the class."""
        made = self.given() if isinstance(self.given, type) else self.given
        return cast(Agent, made)


__all__ = ["Evaluation", "evaluate"]


def evaluate(
    policy: Agent | type[Agent] | str | Path,
    suite: str | Suite = DEFAULT_SUITE,
    *,
    channel: str | Path | Channel | None = None,
    isolation: str = AUTO,
    jobs: int = 1,
    progress: bool = False,
) -> Evaluation:
    """Play a policy through a suite of lifts and score it.

    Parameters
    ----------
    policy
        An object with ``reset(seed)`` and ``act(observation)``, or a class of such objects: it acts
        in this process. An object plays all lifts, so its ``reset`` must clear the last one; a
        class makes a new object for each lift.
        Or a text, as for ``colift run``: a name of :func:`.list_policies`, with parameters after a
        comma if any, ``module:Class``, ``file.py:Class``, or the folder of a submission.
    suite
        A name of :func:`.list_suites`, or a suite made by :mod:`colift.benchmark.suites.suite`.
    channel
        The network between the robot and the policy: a name such as ``"home"``, a TOML file, or a
        :class:`.Channel`; None for none. The baselines have none.
    isolation
        Isolation level of a policy given as text. By default colift's own policies act in this
        process, and all others in the strongest sandbox that works here.
    jobs
        Number of worker processes; with 1 all lifts are played in this process. A script that asks
        for more must do so under ``if __name__ == "__main__":``, as with any pool of processes.
    progress
        Whether to show a bar on a terminal's stderr.

    Returns
    -------
    Evaluation
        The outcome: ``print`` shows it as a table, its attributes are the numbers.

    Raises
    ------
    InputError
        If there is no such policy, suite, channel or isolation, or the policy cannot be used.
    EvaluatorFault
        If the machine, not the policy, fails repeatedly.
    KeyboardInterrupt
        After Ctrl-C; the finished lifts are discarded.
    """
    spec = policy_spec(policy, isolation, jobs)
    played = make_suite(suite) if isinstance(suite, str) else suite
    network = chosen_channel(channel)
    baselines = shipped_baselines(played)
    total = played.size * (1 if baselines else 1 + len(BASELINES))
    bar = progress_bar(spec.name, total) if progress else nullcontext(lambda done: None)
    with bar as advance, local_pool(jobs) as pool:
        run = run_suite(spec, played, executor=pool, progress=advance, channel=network)
        if not run.complete:
            raise KeyboardInterrupt
        if baselines is None:
            baselines = play_baselines(played, executor=pool, progress=advance)
            if baselines.keys() != set(BASELINES):
                raise KeyboardInterrupt
    return Evaluation(run=run, results=results(run, baselines))


def chosen_channel(channel: str | Path | Channel | None) -> Channel | None:
    """Return a channel, given by its name, by its file, or itself."""
    return make_channel(str(channel)) if isinstance(channel, str | Path) else channel


def policy_spec(policy: object, isolation: str, jobs: int) -> AgentSpec:
    """Return the specification of a policy for :func:`evaluate`."""
    if isinstance(policy, str | Path):
        return choose_policy(str(policy), isolation)
    if isolation not in (AUTO, NONE):
        raise InputError(
            f"isolation {isolation!r}: an object or a class acts in this process; give its file, "
            "file.py:Class, to play it in a sandbox"
        )
    given = GivenPolicy(given=policy)
    if jobs > 1 and given.type.__module__ == "__main__":
        raise InputError(
            f"{jobs} processes cannot import {given.name}, which is defined in this script or "
            "notebook: move it to a module, or use jobs=1"
        )
    return given
