"""``colift nao replay``: a recorded trial through the same loop."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from ...agents.hardware.csv_replay import recorded_commands, replay_trial
from ...agents.hardware.recording import read_recording
from ...benchmark.episode.episode import policy_seed
from ..policies import AUTO, choose_policy


def replay_recording(
    recording: Annotated[
        Path, typer.Argument(metavar="CSV", help="A trial of 'nao run --record'.")
    ],
    policy: Annotated[
        str | None, typer.Option(help="Another policy than the one that was recorded.")
    ] = None,
    isolation: Annotated[
        str, typer.Option(help="What keeps the policy apart, as for 'nao run'.")
    ] = AUTO,
) -> None:
    """Play a recorded trial again, and compare the commands with the recorded ones, bit for bit.

    Exit code 1 if one differs. Another policy does not move what was recorded: it shows what it
    would have commanded, given what the recorded one saw.
    """
    recorded = read_recording(recording)
    spec = choose_policy(policy or recorded.policy, isolation)
    spec.check()
    with spec.agent() as agent:
        agent.reset(policy_seed())
        played = replay_trial(recorded, agent)
    there, here = recorded_commands(recorded.record), recorded_commands(played)
    differing = [k for k, (a, b) in enumerate(zip(there, here, strict=False)) if a != b]
    if not differing and len(there) == len(here):
        print(f"{len(here)} steps, every command equal to the bit")
        return
    if differing:
        k = differing[0]
        told = f"step {k}: commanded {there[k]!r} m, now {here[k]!r} m"
    else:
        told = f"{len(there)} steps recorded, {len(here)} played"
    print(f"the commands differ, {told}", file=sys.stderr)
    raise typer.Exit(1)
