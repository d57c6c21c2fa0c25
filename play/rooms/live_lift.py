"""One lift in which a person moves: the same steps as a simulated lift, made frame by frame."""

from collections.abc import Sequence
from typing import NamedTuple

from colift.agents.agent import Action, Agent, Observation
from colift.agents.humans import Hand
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode, outcome
from colift.benchmark.episode.recorder import Recorder
from colift.benchmark.episode.turns import Turns


class Shown(NamedTuple):
    """Content of a frame: both ends of the table at the same time."""

    frame: int
    """Frames since the beginning of the lift."""
    human_end: float
    """Height of the human's end [m]."""
    robot_end: float
    """Height of the far end [m]."""
    human_force: float
    """Force of the human's hands on the table [N]."""


class LiveLift:
    """A lift whose human is a hand, and whose far end is held by an agent or by a second hand.

    Parameters
    ----------
    lift
        The lift; it is reset here.
    seed
        The episode's seed.
    human
        The hand of the human's end.
    partner
        The agent at the far end, or the hand of a second person.
    """

    def __init__(self, lift: Lift, seed: int, human: Hand, partner: Agent | Hand) -> None:
        lift.reset(seed)
        self.lift = lift
        self._human = human
        self._hand = None if isinstance(partner, Agent) else partner
        agent = partner if isinstance(partner, Agent) else _Nobody()
        self._turns = Turns(agent, lift.partner_size)
        self._recorder = Recorder(lift)
        self._references: list[float] = []
        self._far: list[float] = []
        self._commands: Sequence[float] = ()
        self._internals: dict[str, float] = {}
        self._action: Sequence[float] = ()
        self._turns.start()

    @property
    def over(self) -> bool:
        """Whether the lift has ended: by its horizon, a drop, or a failure of the partner."""
        return self._turns.failure is not None or self.lift.done

    def frame(self) -> Shown | None:
        """Advance by one frame; None if the partner failed to act at the beginning of a step."""
        lift = self.lift
        place = len(self._references)
        if place == 0 and self._hand is None:
            turn = self._turns.ask(lift.partner_observation())
            if turn is None:
                return None
            self._action, self._internals = turn
            self._commands = lift.commands(list(self._action))
        self._references.append(self._human.next())
        if self._hand is None:
            command = self._commands[place]
        else:
            self._far.append(self._hand.next())
            command = lift.commands(self._far[-1:])[0]
        lift.move(self._references[-1:], [command])
        shown = self.shown(place + 1)
        if len(self._references) == lift.frames_per_step:
            lift.end(command)
            action = self._action if self._hand is None else self._far
            if self._hand is not None:
                self._turns.times.append(0.0)  # A hand takes no time to decide.
            self._recorder.step(self._references, action, self._internals)
            self._references, self._far = [], []
        return shown

    def shown(self, ahead: int = 0) -> Shown:
        """Return the content of the present frame, ``ahead`` frames into the step."""
        world = self.lift.world
        return Shown(
            self.lift.frame + ahead,
            world.human_end[-1],
            world.robot_end[-1],
            world.human_force[-1],
        )

    def outcome(self) -> Episode:
        """Return the outcome; steps that were not completed are not part of it."""
        return outcome(self.lift, self._recorder, self._turns)


class _Nobody:
    """Stands in for an agent where a second hand holds the far end; it is never asked."""

    def reset(self, seed: int) -> None:
        """Do nothing."""

    def act(self, observation: Observation) -> Action:
        """Refuse."""
        raise NotImplementedError
