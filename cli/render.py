"""``colift render``: a lift as picture or film."""

from pathlib import Path
from typing import Annotated

import typer

from ..agents.policies.loading import PolicySpec
from ..benchmark.catalogue import make_scenario
from ..benchmark.scenario import CONTROL_PERIOD, LATENCY
from ..benchmark.tasks import play
from .progress import progress_bar


def render(
    policy: Annotated[
        str, typer.Argument(help="A name of 'colift list', module:Class or file.py:Class.")
    ],
    out: Annotated[Path, typer.Option(metavar="FILE", help="FILE.gif, FILE.mp4 or FILE.png.")],
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
    # Drawing needs matplotlib, which is slow to load: not for the other commands.
    from ..benchmark.rendering.film import film_episode, shown_frames
    from ..benchmark.rendering.writing import check_target

    check_target(out)
    spec = PolicySpec(text=policy)
    played = make_scenario(scenario, subject, control_period=control_period, latency=latency)
    (episode,) = play(spec, played, (seed,))
    pictures = 1 if out.suffix == ".png" else len(shown_frames(episode))
    with progress_bar("drawing", pictures) as progress:
        film_episode(out, episode, played, spec.name, drawn=progress)
    print(f"{out}: {episode.behaviour}/{episode.subject} seed {seed}, ", end="")
    print(f"RMSE {episode.scores.rmse_mm:.1f} mm", end="")
    print(f"; ended early: {episode.failure}" if episode.failure else "")
