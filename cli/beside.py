"""One lift with several partners, side by side, for ``colift render``."""

import dataclasses
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

import typer
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.base.registry import check_plays
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.turns import is_policy_failure
from colift.benchmark.execution.playing import play
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, partner_spec
from colift.benchmark.tables.failures import printed_lines

if TYPE_CHECKING:
    from colift.benchmark.rendering.film import Look

HUMAN: Final = "human"
"""The second person among the partners."""

Lift = tuple[AgentSpec, Scenario]


def checked_look(out: Path, camera: str, speed: float, plays: int, beside: Sequence[str]) -> "Look":
    """Return the look of a picture or film.

    Raises
    ------
    InputError
        If a value is out of range, or has no effect on a file of this kind.
    """
    from colift.benchmark.rendering.film import Look
    from colift.benchmark.rendering.layout import VECTOR
    from colift.benchmark.rendering.writing import SUFFIXES

    look = Look(camera=camera, speed=speed, plays=plays)
    usual = Look()
    films = tuple(each for each in SUFFIXES if each != ".png")
    for option, given, suffixes in (
        ("--camera", look.camera != usual.camera, (*SUFFIXES, *VECTOR)),
        ("--speed", look.speed != usual.speed, films),
        ("--plays", look.plays != usual.plays, (".gif", ".webp")),
        ("--beside", bool(beside), SUFFIXES),
    ):
        if given and out.suffix not in suffixes:
            raise InputError(f"{option} is for {', '.join(suffixes)}, not for {out}")
    return look


def others_in(played: Scenario, names: Sequence[str]) -> Iterator[Lift]:
    """Yield further partners in the lift of a scenario, each with its scenario.

    Raises
    ------
    InputError
        If there is no policy of a name, or it is for another task.
    """
    for name in names:
        if name == HUMAN:
            yield partner_spec(played), dataclasses.replace(played, partner=HUMAN)
        else:
            check_plays(name, played.task.name)
            yield checked_policy(name), played


def played_lift(spec: AgentSpec, played: Scenario, seed: int) -> Episode:
    """Play a lift; if the policy fails, say why, and end the command with 1."""
    (episode,) = play(spec, played, (seed,))
    if is_policy_failure(episode.failure):
        print(f"nothing to draw: the policy failed: {episode.failure}", file=sys.stderr)
        for line in printed_lines(episode.log):
            print(line, file=sys.stderr)
        raise typer.Exit(1)
    return episode


def draw_beside(out: Path, lifts: Sequence[Lift], seed: int, look: "Look") -> None:
    """Play a lift with each of its partners, draw them, and print their scores."""
    from colift.benchmark.rendering.beside import Partner, film_beside
    from colift.benchmark.rendering.film import FPS, shown_frames

    partners = [
        Partner(
            name=HUMAN_HUMAN_LABEL if played.partner == HUMAN else spec.name,
            episode=played_lift(spec, played, seed),
            scenario=played,
        )
        for spec, played in lifts
    ]
    longest = max(len(shown_frames(each.episode, FPS / look.speed)) for each in partners)
    with progress_bar("drawing", 1 if out.suffix == ".png" else longest) as progress:
        film_beside(out, partners, look=look, drawn=progress)
    first = partners[0].episode
    print(f"{out}: {first.behaviour}/{first.subject} seed {seed}, RMSE ", end="")
    print(", ".join(f"{each.name} {each.episode.scores['rmse_mm']:.1f} mm" for each in partners))
