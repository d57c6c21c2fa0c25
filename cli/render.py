"""``colift render``: a lift as a picture, a film or a page with a player."""

import re
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.base.registry import check_plays
from colift.benchmark.bundle.files import is_bundle
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.results.lifts import lift_name, worst_first
from colift.benchmark.robots.robot import DEFAULT_ROBOT, make_robot
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.level.task import LEVEL
from colift.cli.beside import checked_look, draw_beside, others_in, played_lift
from colift.cli.bundles import mention_others
from colift.cli.completion import behaviours, people, policies
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import (
    LATENCY_OPTION,
    LAYOUT_OPTION,
    PERIOD_OPTION,
    RobotName,
    check_folder,
    check_output,
    chosen_layout,
)

if TYPE_CHECKING:
    from colift.benchmark.rendering.film import Look
    from colift.leaderboard.replays.replay import Ghost

HTML: Final = ".html"

OF_A_LIFT: Final = (
    "behaviour",
    "scenario",
    "subject",
    "seed",
    "task",
    "robot",
    "latency",
    "control_period",
    "beside",
)
"""Options that a bundle decides."""


def render_episode(
    context: typer.Context,
    policy: Annotated[
        str,
        typer.Argument(
            metavar="POLICY|BUNDLE",
            help="A policy, as for 'colift run'; or a result bundle, whose worst lift is drawn.",
            autocompletion=policies,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            help="Film (.gif, .webp, .mp4), picture (.png), figure for print (.svg, .pdf), page "
            "with a player (.html) or model in 3-D (.glb); for several lifts a page, or a folder "
            "for pictures.",
        ),
    ],
    worst: Annotated[
        int | None,
        typer.Option(metavar="N", help="Draw the N worst lifts of a bundle; default: 1."),
    ] = None,
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
    layout: Annotated[str | None, LAYOUT_OPTION] = None,
    robot: RobotName = None,
    latency: Annotated[float, LATENCY_OPTION] = LATENCY,
    control_period: Annotated[float, PERIOD_OPTION] = CONTROL_PERIOD,
) -> None:
    """Draw a lift, with the heights of both ends over time and all that its task asks for.

    Exit code 1, and no file, if the policy fails. The lifts of a bundle are drawn as they were
    recorded, without the policy; what does not follow from the recorded actions is reported.

    Example: colift render blend --behaviour pause --out lift.png
    """
    size = None if layout is None else chosen_layout(layout)
    look = checked_look(out, camera, speed, plays, beside or ())
    if is_bundle(Path(policy)):
        _render_bundle(context, Path(policy), 1 if worst is None else worst, out, look, size)
        return
    if worst is not None:
        raise InputError(f"--worst is for a result bundle, and {policy} is none")
    _check(out)
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
        episode = played_lift(spec, played, seed)
        _write(out, episode, played, spec.name, look, size)
    _report(out, episode)


def _report(out: Path, episode: Episode) -> None:
    """Print the file of a lift, and its score."""
    name = lift_name(episode.behaviour, episode.subject, episode.trial, episode.seed)
    print(f"{out}: {name}, RMSE {episode.scores['rmse_mm']:.1f} mm", end="")
    print(f"; ended early: {episode.failure}" if episode.failure else "")


# Drawing needs matplotlib, which is slow to load: not for the other commands.
def _check(out: Path) -> None:
    from colift.benchmark.rendering.lift_file import KNOWN, check_lift_file

    if out.suffix not in (*KNOWN, HTML):
        known = ", ".join((*KNOWN, HTML))
        raise InputError(f"cannot write {out}: its suffix must be one of {known}")
    if out.suffix != HTML:
        check_lift_file(out)
    check_output(out)


def _write(
    out: Path, episode: Episode, played: Scenario, name: str, look: "Look", layout: Layout | None
) -> None:
    from colift.benchmark.rendering.lift_file import pictures_in, write_lift
    from colift.leaderboard.replays.replay import play_ghost

    if out.suffix == HTML:
        _write_page(out, [(episode, played, play_ghost(played, episode.seed))], name)
        return
    with progress_bar("drawing", pictures_in(out, episode, look)) as progress:
        write_lift(out, episode, played, name, look=look, layout=layout, drawn=progress)


def _write_page(out: Path, lifts: Iterable[tuple[Episode, Scenario, "Ghost"]], name: str) -> None:
    from colift.leaderboard.replays.html import replay_page
    from colift.leaderboard.replays.replay import replay_content

    replays = [replay_content(*each, policy=name) for each in lifts]
    out.write_text(replay_page(replays), encoding="utf-8")


def _render_bundle(
    context: typer.Context,
    folder: Path,
    worst: int,
    out: Path,
    look: "Look",
    layout: Layout | None,
) -> None:
    """Draw the worst lifts of a bundle, and report what does not follow from their actions."""
    from colift.benchmark.bundle.present import read_present
    from colift.benchmark.verification.replaying import replayed_lifts
    from colift.leaderboard.replays.replay import play_ghosts

    for name in OF_A_LIFT:
        source = context.get_parameter_source(name)
        if source is not None and source.name == "COMMANDLINE":
            option = name.replace("_", "-")
            raise InputError(f"--{option} is for a policy: {folder} is a bundle with its own lifts")
    if worst < 1:
        raise InputError(f"--worst must be 1 or more, got {worst}")
    bundle, run = read_present(folder)
    mention_others(folder)
    ordered = worst_first(each.scores["rmse_mm"] for each in run.episodes)
    rows = [row for row in ordered if len(run.episodes[row].trace.human_end)][:worst]
    if not rows:
        failure = run.episodes[0].failure
        raise InputError(f"no lift of {folder} has a frame to draw; the first ended: {failure}")
    places = [bundle.indices[row] for row in rows]
    files = _files(out, [run.episodes[row] for row in rows])
    with reported_interrupt(f"{out} is not drawn"):
        lifts = [*replayed_lifts(bundle, run.suite, rows)]
        for lift in lifts:
            for finding in lift.findings[:1]:
                print(f"note: it does not follow from the actions: {finding}", file=sys.stderr)
        if out.suffix == HTML:
            ghosts = play_ghosts(run.suite, places)
            shown = zip(lifts, places, strict=True)
            _write_page(
                out,
                [(lift.episode, lift.scenario, ghosts[place]) for lift, place in shown],
                run.policy,
            )
        for lift, file in zip(lifts, files, strict=True):
            if out.suffix != HTML:
                _write(file, lift.episode, lift.scenario, run.policy, look, layout)
            _report(file, lift.episode)


def _files(out: Path, episodes: Sequence[Episode]) -> list[Path]:
    """Return the file of each lift: the page of all, the picture of one, or pictures in a folder.

    Raises
    ------
    InputError
        If it cannot be written, or one picture would have to show several lifts.
    """
    if out.suffix and not out.is_dir():
        _check(out)
        if len(episodes) > 1 and out.suffix != HTML:
            raise InputError(
                f"{len(episodes)} lifts do not fit into {out}: name a folder, or a page ({HTML})"
            )
        return [out] * len(episodes)
    check_folder("--out", out)
    names = (
        f"{place}-{each.behaviour}-{each.subject}-{each.trial}-seed-{each.seed}"
        for place, each in enumerate(episodes, 1)
    )
    return [out / f"{re.sub('[^A-Za-z0-9_.]+', '-', name)}.png" for name in names]
