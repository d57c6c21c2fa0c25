"""``colift nao replay``: a recorded trial, played again through the same control loop."""

import sys
from pathlib import Path
from typing import Annotated

import typer
from colift.agents.hardware.rerun import logged_commands, rerun_trial
from colift.agents.hardware.trial_log import read_trial
from colift.agents.spec import AUTO
from colift.agents.submissions.choice import checked_policy
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.tables.printing import counted
from colift.cli.options import PolicyIsolation


def replay_recording(
    recording: Annotated[
        Path, typer.Argument(metavar="CSV", help="A trial of 'nao run --record'.")
    ],
    policy: Annotated[
        str | None, typer.Option(metavar="POLICY", help="Policy; default: the recorded one.")
    ] = None,
    isolation: PolicyIsolation = AUTO,
) -> None:
    """Replay a recorded trial, and compare each command with the recorded one, bit for bit.

    Exit code 1 if a command differs. Another policy, too, observes the recording: its commands do
    not change the observations.

    Example: colift nao replay trials/lift-01.csv
    """
    recorded = read_trial(recording)
    spec = checked_policy(policy or recorded.policy, isolation)
    with spec.agent() as agent:
        agent.reset(policy_seed())
        played = rerun_trial(recorded, agent)
    there, here = logged_commands(recorded.log), logged_commands(played)
    differing = [k for k, (a, b) in enumerate(zip(there, here, strict=False)) if a != b]
    if not differing and len(there) == len(here):
        print(f"{counted(len(here), 'step')}, every command equal to the bit")
        return
    if differing:
        k = differing[0]
        difference = f"step {k}: commanded {there[k]!r} m, now {here[k]!r} m"
    else:
        difference = f"{counted(len(there), 'step')} recorded, {len(here)} played"
    print(f"the commands differ, {difference}", file=sys.stderr)
    raise typer.Exit(1)
