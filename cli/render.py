"""``colift render``: a lift as picture, film, or a page on which it can be played."""

from pathlib import Path
from typing import Annotated, Final

import typer

from ..agents.errors import InputError
from ..agents.policies.loading import PolicySpec
from ..benchmark.catalogue import make_scenario
from ..benchmark.episode import Episode
from ..benchmark.scenario import CONTROL_PERIOD, LATENCY, Scenario
from ..benchmark.tasks import play
from .output import check_output
from .progress import progress_bar

HTML: Final = ".html"


def render(
    policy: Annotated[
        str, typer.Argument(help="A name of 'colift list', module:Class or file.py:Class.")
    ],
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            help="FILE.gif, FILE.mp4, FILE.png, or FILE.html: a replay to play, in one file.",
        ),
    ],
    scenario: Annotated[
        str, typer.Option(help="The human's behaviour, or recorded:FILE.csv#TRIAL.")
    ] = "smooth",
    subject: Annotated[str, typer.Option(help="Who the human is: S1 to S5, or draw-N.")] = "S1",
    seed: Annotated[int, typer.Option(help="The episode's seed.")] = 0,
    latency: Annotated[
        float, typer.Option(metavar="S", help="Age of the robot's data, in seconds.")
    ] = LATENCY,
    control_period: Annotated[
        float, typer.Option(metavar="S", help="Time between two decisions, in seconds.")
    ] = CONTROL_PERIOD,
) -> None:
    """Draw a lift, seen from the side, with the heights of both ends under it."""
    _check(out)
    spec = PolicySpec(text=policy)
    played = make_scenario(scenario, subject, control_period=control_period, latency=latency)
    (episode,) = play(spec, played, (seed,))
    if out.suffix == HTML:
        _write_page(out, episode, played, spec.name)
    else:
        _film(out, episode, played, spec.name)
    print(f"{out}: {episode.behaviour}/{episode.subject} seed {seed}, ", end="")
    print(f"RMSE {episode.scores.rmse_mm:.1f} mm", end="")
    print(f"; ended early: {episode.failure}" if episode.failure else "")


# Drawing needs matplotlib, which is slow to load: not for the other commands.
def _check(out: Path) -> None:
    from ..benchmark.rendering.writing import SUFFIXES, check_target

    if out.suffix not in (*SUFFIXES, HTML):
        known = ", ".join((*SUFFIXES, HTML))
        raise InputError(f"cannot write {out}: its suffix must be one of {known}")
    if out.suffix == HTML:
        check_output(out)
    else:
        check_target(out)


def _film(out: Path, episode: Episode, played: Scenario, name: str) -> None:
    from ..benchmark.rendering.film import film_episode, shown_frames

    pictures = 1 if out.suffix == ".png" else len(shown_frames(episode))
    with progress_bar("drawing", pictures) as progress:
        film_episode(out, episode, played, name, drawn=progress)


def _write_page(out: Path, episode: Episode, played: Scenario, name: str) -> None:
    from ..leaderboard.replays.ghost import play_ghost
    from ..leaderboard.replays.html import replay_page
    from ..leaderboard.replays.replay import replay

    ghost = play_ghost(played, episode.seed)
    page = replay_page([replay(episode, played, ghost, policy=name)])
    out.write_text(page, encoding="utf-8")
