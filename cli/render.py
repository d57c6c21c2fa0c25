"""``colift render``: a lift as a picture, a film or a page with a player."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.base.registry import check_plays
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.robots.robot import DEFAULT_ROBOT, make_robot
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.level.task import LEVEL
from colift.cli.beside import checked_look, draw_beside, others_in, played_lift
from colift.cli.completion import behaviours, people, policies
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import (
    LATENCY_OPTION,
    PERIOD_OPTION,
    PolicyName,
    RobotName,
    check_output,
)

if TYPE_CHECKING:
    from colift.benchmark.rendering.film import Look

HTML: Final = ".html"
MODEL: Final = ".glb"


def render_episode(
    policy: PolicyName,
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            help="Film (.gif, .webp, .mp4), picture (.png), page with a player (.html) or model in "
            "3-D (.glb).",
        ),
    ],
    behaviour: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="The human's behaviour, or recorded:FILE.csv#TRIAL; default: the task's first.",
            autocompletion=behaviours,
        ),
    ] = None,
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
    camera: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="View of pictures and films: side, close, front (behind the robot) or top.",
        ),
    ] = "side",
    speed: Annotated[
        float, typer.Option(metavar="X", help="Speed of a film, relative to the lift.")
    ] = 1.0,
    plays: Annotated[
        int,
        typer.Option(metavar="N", help="Times that a .gif or .webp plays; 0: without end."),
    ] = 0,
    beside: Annotated[
        list[str] | None,
        typer.Option(
            metavar="POLICY",
            help="Another policy in the same lift, side by side; repeatable. 'human' is a second "
            "person.",
            autocompletion=policies,
        ),
    ] = None,
    robot: RobotName = None,
    latency: Annotated[float, LATENCY_OPTION] = LATENCY,
    control_period: Annotated[float, PERIOD_OPTION] = CONTROL_PERIOD,
) -> None:
    """Draw a lift, with the heights of both ends over time and all that its task asks for.

    Exit code 1, and no file, if the policy fails.
    """
    _check(out)
    look = checked_look(out, camera, speed, plays, beside or ())
    if seed < 0:
        raise InputError(f"--seed must not be negative, got {seed}")
    holder = robot or DEFAULT_ROBOT
    make_robot(holder)
    named = behaviour or scenario or make_task(task).behaviours[0]
    played = make_scenario(named, subject, holder, control_period, latency, task)
    check_plays(policy, task)
    spec = checked_policy(policy)
    if beside:
        with reported_interrupt(f"{out} is not drawn"):
            draw_beside(out, [(spec, played), *others_in(played, beside)], seed, look)
        return
    with reported_interrupt(f"{out} is not drawn"):
        episode = _drawn(spec, played, seed, out, look)
    print(f"{out}: {episode.behaviour}/{episode.subject} seed {seed}, ", end="")
    print(f"RMSE {episode.scores['rmse_mm']:.1f} mm", end="")
    print(f"; ended early: {episode.failure}" if episode.failure else "")


def _drawn(spec: AgentSpec, played: Scenario, seed: int, out: Path, look: "Look") -> Episode:
    """Play a lift, draw it, and return it."""
    episode = played_lift(spec, played, seed)
    if out.suffix == HTML:
        _write_page(out, episode, played, spec.name)
    elif out.suffix == MODEL:
        _write_model(out, episode, played, spec.name)
    else:
        _film(out, episode, played, spec.name, look)
    return episode


# Drawing needs matplotlib, which is slow to load: not for the other commands.
def _check(out: Path) -> None:
    from colift.benchmark.rendering.gltf import check_model
    from colift.benchmark.rendering.writing import SUFFIXES, check_film

    if out.suffix not in (*SUFFIXES, HTML, MODEL):
        known = ", ".join((*SUFFIXES, HTML, MODEL))
        raise InputError(f"cannot write {out}: its suffix must be one of {known}")
    if out.suffix in SUFFIXES:
        check_film(out)
        return
    check_output(out)
    if out.suffix == MODEL:
        check_model(out)


def _film(out: Path, episode: Episode, played: Scenario, name: str, look: "Look") -> None:
    from colift.benchmark.rendering.film import FPS, film_episode, shown_frames

    pictures = 1 if out.suffix == ".png" else len(shown_frames(episode, FPS / look.speed))
    with progress_bar("drawing", pictures) as progress:
        film_episode(out, episode, played, name, look=look, drawn=progress)


def _write_model(out: Path, episode: Episode, played: Scenario, name: str) -> None:
    from colift.benchmark.rendering.gltf import write_model

    write_model(out, episode, played, name)


def _write_page(out: Path, episode: Episode, played: Scenario, name: str) -> None:
    from colift.leaderboard.replays.html import replay_page
    from colift.leaderboard.replays.replay import play_ghost, replay_content

    ghost = play_ghost(played, episode.seed)
    page = replay_page([replay_content(episode, played, ghost, policy=name)])
    out.write_text(page, encoding="utf-8")
