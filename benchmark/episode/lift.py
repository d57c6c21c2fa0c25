"""The lift: sensors, actions and time on top of a world, independent of PettingZoo."""

from collections import deque
from collections.abc import Callable, Sequence
from typing import Any, Final, Protocol

import numpy as np
from colift.agents.actions import checked_action
from colift.agents.agent import FRAME, HISTORY, Action, Agent, HumanObservation, Observation
from colift.agents.humans import Embodied, Plan, Subject
from colift.agents.humans.hand import HandMemory, NoiseStream, carry_out
from colift.agents.rules import SCALARS, Drawn, NumberSeries
from colift.benchmark.episode.bodies import Bodies, bodies_of
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import within_range
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.episode.sensing import drawn_errors, sight, touch
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import HISTORY_FRAMES, FarEnd, Intended, World
from colift.benchmark.world.table import Table
from numpy.typing import ArrayLike, NDArray

READ: Final = (
    "human_end",
    "robot_end",
    "human_force",
    "robot_force",
    "robot_torque",
    "ball_place",
)
"""Read-outs of a world that rules may see; see :meth:`.View.seen`."""

MakeWorld = Callable[[BodyParameters, FarEnd, Table], World]
"""Returns a world of a person, a holder of the far end, and a table."""


class Lift:
    """One human, one partner, one table, from rest to rest.

    A step is one control period of the robot: ``frames_per_step`` frames. The robot's action
    changes its hand command, which moves at constant speed over the period; the human's action
    is a hand reference for each frame. A step is made as a whole, by :meth:`step`, or frame by
    frame while a person moves: :meth:`commands`, :meth:`move` for each frame, :meth:`end`. The
    results are equal bit for bit.

    Parameters
    ----------
    scenario
        The people, the task and the timing.
    world
        Makes the world of the human's body and the far end; the task's own world if None.
    """

    def __init__(self, scenario: Scenario, *, world: MakeWorld | None = None) -> None:
        self.scenario = scenario
        self.task = scenario.task
        self.seat = seat = scenario.seat
        self.frames_per_step = scenario.frames_per_step
        self.partner_size = seat.action_size(self.frames_per_step)
        self.step_limit = seat.action_range(scenario.control_period)[1]
        """Largest change of a robot's hand command in one step [m]."""
        self.visual, self.haptic = _delays(scenario.subject)
        far = (0, 0) if seat.person is None else _delays(seat.person)
        self.partner_visual, self.partner_haptic = far
        self._person = scenario.rules
        self._make = world or self.task.world
        self.bodies: Bodies | None = None
        """What the world is made of; None if there is none yet: with conditions, before a reset."""
        if scenario.conditions is None:
            self._enter(bodies_of(scenario, None))

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``: draw the human's plan and the sensors' noise."""
        scenario, task, size = self.scenario, self.task, self.frames_per_step
        self.seed = seed
        self.plan: Plan = scenario.human.plan(scenario.subject, self.role_seed("plan"))
        steps = -(-len(self.plan.target) // size)
        self.horizon = steps * size
        conditions, role = scenario.conditions, self.role_seed
        self.conditions = None if conditions is None else conditions.draw(role, steps, size)
        """The drawn conditions; None if the scenario has none."""
        drawn = self.conditions
        ages = scenario.latency_frames if drawn is None else drawn.ages
        self._ages: list[int] = np.broadcast_to(ages, steps + 1).tolist()
        self._errors: list[list[float]] = drawn_errors(
            task.senses, task.touch, role, steps, size, ages, 1.0 if drawn is None else drawn.noise
        ).tolist()
        if drawn is not None:
            self._enter(bodies_of(scenario, drawn))
        self.world.reset()
        self.frame = 0
        self.command = 0.0
        self.dropped: str | None = None
        self.begin(lasting(self.plan.target, self.horizon))

    def _enter(self, bodies: Bodies) -> None:
        """Take a world of some bodies: the present one if it has the same."""
        if bodies != self.bodies:
            self.close()
            self.bodies, self.table = bodies, bodies.table
            self.world: World = self._make(*bodies)

    @property
    def latency(self) -> int:
        """Age of the motion capture's sample now, in frames."""
        return self._ages[self.frame // self.frames_per_step]

    def begin(self, target: NDArray[np.float64]) -> None:
        """Let the person begin to carry out intended heights [m], one per frame."""
        world, person = self.world, self._person
        self.target = target
        series, self.facts = self.task.setting(self.plan, self.horizon, self.role_seed)
        self.due: Any = series
        """The task's series, arrays (horizon,)."""
        size = self.frames_per_step
        chance, manner = person.draw(
            self.scenario.subject, self.role_seed, self.horizon // size, size
        )
        self.drawn: Drawn[float] = Drawn(
            NumberSeries.of(target), _numbers(series), self.facts, _numbers(chance), manner
        )
        self._read: dict[str, Sequence[float]] = {name: getattr(world, name) for name in READ}
        self._intentions: dict[str, deque[float]] = {}
        self._memory = person.begin(SCALARS, 0.0, False)
        self._intend()

    def seen(self, name: str, age: int) -> float:
        """Return a past read-out; see :meth:`.View.seen`."""
        past = self._read.get(name)
        if past is None:
            past = self._intentions[name] if self._intentions else _REST
        return past[-1 - age]

    @property
    def hand(self) -> float:
        """Height of the hands at the far end by their encoders [m]."""
        return self.world.hand_height

    def _intend(self) -> None:
        """Let the person decide on the coming step."""
        self._memory, self.intention = self._person.intend(
            SCALARS, self.drawn, self._memory, self, self.frames_per_step
        )
        self._moved = 0

    def role_seed(self, role: str) -> int:
        """Return the episode's seed of a role, independent of those of other scenarios."""
        return derive_seed(self.seed, f"{role}/{self.scenario.name}")

    @property
    def truncated(self) -> bool:
        """Whether the horizon has been reached."""
        return self.frame >= self.horizon

    @property
    def done(self) -> bool:
        """Whether the episode is over, by the horizon or by a drop."""
        return self.dropped is not None or self.frame >= self.horizon

    def human(self) -> "Human":
        """Return the human of the current episode: scripted, or brought by the behaviour."""
        behaviour, subject = self.scenario.human, self.scenario.subject
        if isinstance(behaviour, Embodied):
            agent = behaviour.person(subject)
            agent.reset(self.role_seed("human"))
            return Observing(self, agent)
        return Scripted(self)

    def scripted_human(self) -> Agent:
        """Return the human of the current episode as an agent; it does without the observation."""
        return self.human()

    def step(self, human: ArrayLike, partner: ArrayLike) -> None:
        """Advance by one control period.

        Parameters
        ----------
        human
            Hand reference for each frame [m], shape ``(frames_per_step,)``.
        partner
            The robot's change of its hand command [m], shape ``(1,)``, clipped to the hand's speed
            and stroke; or the second human's hand references, as ``human``.

        Raises
        ------
        ActionError
            If an action has the wrong shape or is not finite.
        """
        self.carry_out(
            checked_action("human", human, self.frames_per_step),
            checked_action("robot", partner, self.partner_size),
        )

    def carry_out(self, human: list[float], partner: list[float]) -> None:
        """Advance by one control period, by two actions that :func:`.checked_action` returned."""
        commands = self.commands(partner)
        self.move(human, commands)
        self.end(commands[-1])

    def commands(self, partner: list[float]) -> Sequence[float]:
        """Return the heights to reach at the far end, one per frame, for its holder's action."""
        return self.seat.commands(self, partner)

    def move(self, human: Sequence[float], commands: Sequence[float]) -> None:
        """Advance by a frame for each hand reference and command of the far end [m]."""
        intended = self._driven(human) if self.task.touch else None
        self.world.advance(within_range(human), commands, intended)

    def _driven(self, human: Sequence[float]) -> Intended:
        """Return the person's intention in the frames of some hand references."""
        drive, kind, first = self._person.drive, type(self.intention), self._moved
        self._moved += len(human)
        columns = (column[first : self._moved] for column in self.intention)
        driven = [
            drive(SCALARS, self.drawn, kind(*frame), reference)
            for *frame, reference in zip(*columns, human, strict=True)
        ]
        return [difference for difference, _ in driven], [pitch for _, pitch in driven]

    def end(self, command: float) -> None:
        """End the control period after all of its frames, with its last command [m]."""
        for name, column in self.intention._asdict().items():
            if name not in self._intentions:
                self._intentions[name] = deque([0.0] * HISTORY_FRAMES, HISTORY_FRAMES)
            self._intentions[name].extend(column)
        self.command = command
        self.frame += self.frames_per_step
        self.dropped = self.task.failure(self)
        self._intend()

    def partner_observation(self) -> Observation:
        """Return the observation of the holder of the robot's end."""
        return self.seat.observation(self.task, self)

    def human_observation(self) -> Observation:
        """Return the human's observation."""
        return self.task.human_observation(self)

    def robot_view(self) -> Observation:
        """Return the robot's senses now: sight, touch, and the task's own."""
        task = self.task
        exact = [*sight(SCALARS, self)]
        if task.touch:
            exact += touch(SCALARS, self)
        if task.senses:
            exact += task.observe(SCALARS, self.drawn, self)
        errors = self._errors[self.frame // self.frames_per_step]
        return np.array([value + error for value, error in zip(exact, errors, strict=True)])

    def planned(self) -> Observation:
        """Return the planned height of the human's end in each frame of the coming step [m]."""
        return np.array(self.drawn.target.next(self.frame, self.frames_per_step))

    def human_view(self, target: Observation) -> Observation:
        """Return the human's senses now, laid out as :class:`.HumanObservation`.

        ``target`` is the private target: the intended height in each frame of the step [m].
        """
        world = self.world
        return self._senses(
            world.human_end,
            world.human_velocity,
            world.robot_end,
            world.human_force,
            target,
            (self.visual, self.haptic),
        )

    def second_person_view(self, target: Observation) -> Observation:
        """Return the senses of a second human at the robot's end, as :meth:`human_view`."""
        world = self.world
        return self._senses(
            world.robot_end,
            world.robot_velocity,
            world.human_end,
            world.robot_force,
            target,
            (self.partner_visual, self.partner_haptic),
        )

    def seen_by_second_person(self) -> float:
        """Return the height of the human's end [m] that a second human sees now."""
        return self.world.human_end[-1 - self.partner_visual]

    def clipped(self, actions: NDArray[np.float64]) -> float:
        """Return the share of actions beyond the hands' speed; NaN for a second human."""
        return self.seat.clipped(actions, self.scenario.control_period)

    def _senses(
        self,
        own: list[float],
        velocity: list[float],
        other: list[float],
        force: list[float],
        target: Observation,
        delays: tuple[int, int],
    ) -> Observation:
        seen, felt = len(other) - delays[0], len(force) - delays[1]
        view = np.empty(HumanObservation.size(self.frames_per_step))
        view[HumanObservation.OWN_HEIGHT] = own[-HISTORY:]
        view[HumanObservation.OWN_VELOCITY] = velocity[-HISTORY:]
        view[HumanObservation.OTHER_END] = other[seen - HISTORY : seen]
        view[HumanObservation.HAND_FORCE] = force[felt - HISTORY : felt]
        view[HumanObservation.TARGET] = target
        view[HumanObservation.TIME] = self.frame * FRAME
        return view

    def close(self) -> None:
        """Release the world, if there is one."""
        if self.bodies is not None:
            self.world.close()


def lasting(values: NDArray[np.float64], frames: int) -> NDArray[np.float64]:
    """Return values, one per frame, for as many frames; the last one lasts."""
    return np.concatenate((values, np.full(frames - len(values), values[-1])))


_REST: Final = [0.0] * HISTORY_FRAMES


def _numbers(series: Any) -> Any:
    """Return the named tuple of arrays as one of series."""
    return type(series)(*map(NumberSeries.of, series)) if series else series


class Human(Agent, Protocol):
    """The human of a lift, who is asked once in each step."""

    def references(self) -> list[float]:
        """Return the hand's reference height in each frame of the coming step [m]."""


class Scripted:
    """Carries out the intentions of a lift's person as the subject would (:func:`.carry_out`).

    The hand's noise depends on seed and frame alone: it is the same whatever the robot does.
    """

    def __init__(self, lift: Lift) -> None:
        self._lift = lift
        self.reset(lift.role_seed("human"))

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._noise = NoiseStream(self._lift.scenario.subject, seed)
        self._memory = HandMemory(0.0, 0.0, 0.0)

    def act(self, observation: Observation) -> Action:
        """Return the references of the coming step; the person knows the lift itself."""
        return np.array(self.references())

    def references(self) -> list[float]:
        """Return the hand's reference height in each frame of the coming step [m]."""
        lift, first = self._lift, self._lift.frame
        noise = self._noise.between(first, first + lift.frames_per_step)
        self._memory, found = carry_out(SCALARS, self._memory, lift, lift.intention.target, noise)
        return list(found)


class Observing:
    """An agent as the human of a lift, by the human's observations."""

    def __init__(self, lift: Lift, agent: Agent) -> None:
        self._lift, self._agent = lift, agent

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._agent.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the agent's references."""
        return self._agent.act(observation)

    def references(self) -> list[float]:
        """Return the references of the coming step [m].

        Raises
        ------
        ActionError
            If the agent's action is not usable.
        """
        lift = self._lift
        chosen = self._agent.act(lift.human_observation())
        return checked_action("human", chosen, lift.frames_per_step)


def _delays(person: Subject) -> tuple[int, int]:
    """Return a person's visual and haptic delay in frames."""
    return round(person.visual_delay / FRAME), round(person.haptic_delay / FRAME)
