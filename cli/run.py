"""``colift run``: the evaluation of a policy on a suite."""

from pathlib import Path
from typing import Annotated

import typer
from colift.agents.spec import AUTO
from colift.cli.options import (
    LATENCY_OPTION,
    PERIOD_OPTION,
    AsJson,
    AsTheyWere,
    Behaviours,
    ChannelName,
    Dask,
    InSessions,
    Jobs,
    PolicyIsolation,
    PolicyName,
    Recordings,
    RobotName,
    Seeds,
    SuiteName,
    chosen_channel,
    chosen_suite,
    executor,
)


def run(
    policy: PolicyName,
    suite: SuiteName = None,
    behaviour: Behaviours = None,
    seeds: Seeds = None,
    recordings: Recordings = None,
    as_recorded: AsTheyWere = False,
    session: InSessions = False,
    robot: RobotName = None,
    latency: Annotated[float | None, LATENCY_OPTION] = None,
    control_period: Annotated[float | None, PERIOD_OPTION] = None,
    channel: ChannelName = None,
    isolation: PolicyIsolation = AUTO,
    jobs: Jobs = None,
    dask: Dask = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the result bundle.")
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace the finished result bundle in --out.")
    ] = False,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="Resume the interrupted run in --out."),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Evaluate a policy on a suite, and compare it with two people.

    With --out, each lift is saved when it is finished, and an interrupted run can be resumed.

    Example: colift run blend --suite quick-v1 --out bundle
    """
    # The engine takes a second to import: not for a help text or a completion.
    from colift.cli.evaluation import Bundle, evaluate

    episodes = chosen_suite(
        suite, seeds, recordings, behaviour, robot, as_recorded=as_recorded, session=session
    ).with_timing(latency, control_period)
    network = chosen_channel(channel)
    bundle = Bundle(out, force=force, resume=resume)
    bundle.check()
    workers = executor(jobs, dask)
    evaluate(policy, isolation, episodes, network, workers, bundle, as_json=as_json)
