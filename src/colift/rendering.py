"""``colift.render``: a picture of one lift, by one call."""

from dataclasses import dataclass
from html import escape
from pathlib import Path

from colift.agents.agent import Agent
from colift.agents.spec import AUTO
from colift.base.errors import InputError
from colift.base.registry import check_plays
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.episode.turns import is_policy_failure
from colift.benchmark.execution.playing import play
from colift.benchmark.rendering.cameras import check_camera
from colift.benchmark.robots.robot import DEFAULT_ROBOT, make_robot
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tables.failures import printed_lines
from colift.benchmark.tasks.level.task import LEVEL
from colift.evaluation import policy_spec

__all__ = ["RenderedLift", "render"]


@dataclass(frozen=True, kw_only=True, eq=False)
class RenderedLift:
    """A lift that was played; a notebook shows three moments, and the heights of both ends."""

    policy: str
    """Name of the policy."""
    episode: Episode
    """The lift: ``episode.scores``, and ``episode.trace`` with the heights frame by frame."""
    scenario: Scenario
    camera: str = "side"
    """View of pictures and films: ``"side"``, ``"close"``, ``"front"`` or ``"top"``."""

    def save(
        self, path: str | Path, layout: str | None = None, *, speed: float = 1.0, plays: int = 0
    ) -> None:
        """Write the lift to a file, as ``colift render --out`` does; only the command has pages.

        Parameters
        ----------
        path
            Film (``.gif``, ``.webp``, ``.mp4``), picture (``.png``), figure for print (``.svg``,
            ``.pdf``) or model in 3-D (``.glb``).
        layout
            Size of a figure, as ``--for``: ``"column"``, ``"page"`` or ``"slide"``; by default that
            of a page. A ``.png`` is a figure if this is given.
        speed
            Speed of a film, relative to the lift.
        plays
            Number of times that a GIF or WebP plays; 0 is without end.

        Raises
        ------
        InputError
            If the suffix or the layout is unknown, the suffix needs an extra that is not installed,
            a number is out of range, or the file cannot be written.
        """
        from colift.benchmark.rendering.film import Look
        from colift.benchmark.rendering.layout import find_layout
        from colift.benchmark.rendering.lift_file import write_lift

        size = None if layout is None else find_layout(layout)
        look = Look(camera=self.camera, speed=speed, plays=plays)
        write_lift(Path(path), self.episode, self.scenario, self.policy, look=look, layout=size)

    def __repr__(self) -> str:
        """Return the lift in one line."""
        from colift.benchmark.rendering.lift_figure import lift_title

        return f"<Lift of {lift_title(self.episode, self.policy)}>"

    def _repr_html_(self) -> str:
        """Return the view of a notebook."""
        from colift.benchmark.rendering.figures import neutral_svg
        from colift.benchmark.rendering.layout import PAGE
        from colift.benchmark.rendering.lift_figure import lift_figure, lift_title

        title = lift_title(self.episode, self.policy)
        figure = lift_figure(self.episode, self.scenario, PAGE, camera=self.camera)
        return f"<p>{escape(title)}</p>\n{neutral_svg(figure, title)}"


def render(
    policy: Agent | type[Agent] | str | Path,
    *,
    behaviour: str | None = None,
    subject: str = "S1",
    seed: int = 0,
    task: str = LEVEL.name,
    camera: str = "side",
    robot: str | None = None,
    latency: float = LATENCY,
    control_period: float = CONTROL_PERIOD,
    isolation: str = AUTO,
) -> RenderedLift:
    """Play one lift and draw it.

    Parameters
    ----------
    policy
        As for :func:`.evaluate`.
    behaviour
        The human's behaviour, a name of :func:`.list_humans` or ``recorded:FILE.csv#TRIAL``; by
        default the task's first.
    subject
        The human's body: ``"S1"`` to ``"S5"``, or ``"draw-N"``.
    seed
        The lift's seed.
    task
        The task of the lift.
    camera
        View of pictures and films: ``"side"``, ``"close"``, ``"front"`` or ``"top"``.
    robot
        Robot at the far end; by default ``"nao"``.
    latency
        Age of the robot's data [s].
    control_period
        Time between two decisions [s].
    isolation
        As for :func:`.evaluate`.

    Returns
    -------
    RenderedLift
        A notebook shows it as a picture; its ``save`` writes files of every kind.

    Raises
    ------
    InputError
        If there is no such policy, behaviour, subject, task, camera or robot, the seed is negative,
        or the policy fails.
    """
    if seed < 0:
        raise InputError(f"seed must not be negative, got {seed}")
    holder = robot or DEFAULT_ROBOT
    make_robot(holder)
    check_camera(camera)
    named = behaviour or make_task(task).behaviours[0]
    played = make_scenario(named, subject, holder, control_period, latency, task)
    if isinstance(policy, str | Path):
        check_plays(str(policy), task)
    spec = policy_spec(policy, isolation, jobs=1)
    spec.check()
    (episode,) = play(spec, played, (seed,))
    if is_policy_failure(episode.failure):
        lines = (f"nothing to draw: the policy failed: {episode.failure}",)
        raise InputError("\n".join([*lines, *printed_lines(episode.log)]))
    return RenderedLift(policy=spec.name, episode=episode, scenario=played, camera=camera)
