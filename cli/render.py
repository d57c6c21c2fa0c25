"""``colift render``: a lift as a picture, a film or a page with a player."""

import sys
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.base.registry import check_plays
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.episode.turns import is_policy_failure
from colift.benchmark.execution.batches import play
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.robots.robot import DEFAULT_ROBOT, make_robot
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tables.failures import printed_lines
from colift.benchmark.tasks.level.task import LEVEL
from colift.cli.completion import behaviours, people
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import (
    LATENCY_OPTION,
    PERIOD_OPTION,
    PolicyName,
    RobotName,
    check_output,
)

HTML: Final = ".html"


def render_episode(
    policy: PolicyName,
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            help="Film (.gif, .mp4), picture (.png) or page with a player (.html).",
        ),
    ],
    behaviour: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="The human's behaviour, or recorded:FILE.csv#TRIAL.",
            autocompletion=behaviours,
        ),
    ] = "smooth",
    scenario: Annotated[
        str | None, typer.Option(help="The old name of --behaviour.", hidden=True)
    ] = None,
    subject: Annotated[
        str,
        typer.Option(
            metavar="NAME", help="The human's body: S1 to S5, or draw-N.", autocompletion=people
        ),
    ] = "S1",
    seed: Annotated[int, typer.Option(metavar="N", help="The lift's seed.")] = 0,
    task: Annotated[
        str, typer.Option(metavar="NAME", help="The task of the lift; see 'colift list'.")
    ] = LEVEL.name,
    robot: RobotName = None,
    latency: Annotated[float, LATENCY_OPTION] = LATENCY,
    control_period: Annotated[float, PERIOD_OPTION] = CONTROL_PERIOD,
) -> None:
    """Draw a lift from the side, with the heights of both ends over time.

    Exit code 1, and no file, if the policy fails.

    Example: colift render blend --behaviour pause --out lift.png
    """
    _check(out)
    if seed < 0:
        raise InputError(f"--seed must not be negative, got {seed}")
    holder = robot or DEFAULT_ROBOT
    make_robot(holder)
    played = make_scenario(scenario or behaviour, subject, holder, control_period, latency, task)
    check_plays(policy, task)
    spec = checked_policy(policy)
    with reported_interrupt(f"{out} is not drawn"):
        episode = _drawn(spec, played, seed, out)
    print(f"{out}: {episode.behaviour}/{episode.subject} seed {seed}, ", end="")
    print(f"RMSE {episode.scores['rmse_mm']:.1f} mm", end="")
    print(f"; ended early: {episode.failure}" if episode.failure else "")


def _drawn(spec: AgentSpec, played: Scenario, seed: int, out: Path) -> Episode:
    """Play a lift, draw it, and return it."""
    (episode,) = play(spec, played, (seed,))
    if is_policy_failure(episode.failure):
        print(f"nothing to draw: the policy failed: {episode.failure}", file=sys.stderr)
        for line in printed_lines(episode.log):
            print(line, file=sys.stderr)
        raise typer.Exit(1)
    if out.suffix == HTML:
        _write_page(out, episode, played, spec.name)
    else:
        _film(out, episode, played, spec.name)
    return episode


# Drawing needs matplotlib, which is slow to load: not for the other commands.
def _check(out: Path) -> None:
    from colift.benchmark.rendering.writing import SUFFIXES, check_film

    if out.suffix not in (*SUFFIXES, HTML):
        known = ", ".join((*SUFFIXES, HTML))
        raise InputError(f"cannot write {out}: its suffix must be one of {known}")
    if out.suffix == HTML:
        check_output(out)
    else:
        check_film(out)


def _film(out: Path, episode: Episode, played: Scenario, name: str) -> None:
    from colift.benchmark.rendering.film import film_episode, shown_frames

    pictures = 1 if out.suffix == ".png" else len(shown_frames(episode))
    with progress_bar("drawing", pictures) as progress:
        film_episode(out, episode, played, name, drawn=progress)


def _write_page(out: Path, episode: Episode, played: Scenario, name: str) -> None:
    from colift.leaderboard.replays.html import replay_page
    from colift.leaderboard.replays.replay import play_ghost, replay_content

    ghost = play_ghost(played, episode.seed)
    page = replay_page([replay_content(episode, played, ghost, policy=name)])
    out.write_text(page, encoding="utf-8")
