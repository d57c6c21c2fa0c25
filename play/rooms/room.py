"""A room: people, a table and a partner, as a machine of messages and times.

It has no socket and no clock: its caller gives it messages and the time, and sends the messages
that it returns. It can therefore run in real time in a process, and in simulated time, bit for bit
the same, in tests.
"""

import dataclasses
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from colift.agents.humans import GoalError, Played, goal_error_mm, missed_words
from colift.agents.spec import AgentSpec
from colift.base.errors import EvaluatorFault, InputError, error_text
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.turns import is_policy_failure
from colift.benchmark.execution.runner import Run
from colift.benchmark.real_lifts.session_folder import SessionFolder
from colift.benchmark.results.goals import lift_goal_errors
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.play.rooms.choice import PERSON, PERSON_AS_ROBOT, SIMULATED, HostChoice
from colift.play.rooms.grip import Grip
from colift.play.rooms.lifting import Lifting
from colift.play.rooms.messages import parse_samples
from colift.play.rooms.partnership import LIFTS, Partnership
from colift.play.rooms.scenarios import cue_of, live_scenario
from colift.play.rooms.seats import ALL, Message, SeatedPerson, Seats
from colift.play.rooms.standing import Standing, ghost_rmse, rehearse

AHEAD_S: Final = 0.5
"""Time from the last closed hand to the first frame [s]: pages need it to prepare."""


SILENT_S: Final = 2.0
"""Longest time without samples of a hand [s]: pages also send samples of resting hands."""


@dataclass(frozen=True, kw_only=True)
class RoomConfig:
    """The settings of a room."""

    folder: Path
    """The session's folder."""
    policies: Mapping[str, AgentSpec]
    """Partners by the names that pages use, in order; the first is chosen first."""
    robot: str = DEFAULT_ROBOT
    """The robot that policies move."""
    cue_seed: int = 0
    """Seed of the session's cues."""


class Room:
    """People who lift with a partner, again and again; see the module."""

    def __init__(self, config: RoomConfig) -> None:
        self._policies, self._robot = config.policies, config.robot
        self._cue_seed = config.cue_seed
        self._session = SessionFolder(config.folder)
        self._seats = Seats()
        self._choice = HostChoice.first(config.policies, config.robot)
        self._prepared = False
        self._partnership: Partnership | None = None
        self._lifting: Lifting | None = None
        self._number = self._session.next_number()
        self._last: tuple[int, Path] | None = None
        self._standing: Standing | None = None

    @property
    def due(self) -> float | None:
        """Time of the room's clock at which :meth:`tick` is due [s]; None if nothing moves."""
        return None if self._lifting is None or self._lifting.over else self._lifting.due

    @property
    def has_work(self) -> bool:
        """Whether :meth:`work` has something to do."""
        if self._lifting is not None:
            return self._lifting.over
        return not self._prepared or self._standing is not None

    def join(self, seat: int) -> list[Message]:
        """Return the messages when a person takes a seat; an earlier page there is replaced."""
        found: list[Message] = []
        if seat in self._seats.people and self._lifts(seat):
            found = self._void("the page was opened again")
        self._seats.people[seat] = SeatedPerson()
        self._session.event("join", seat=seat)
        return [*found, *self._state()]

    def leave(self, seat: int) -> list[Message]:
        """Return the messages when a person's page is gone."""
        if self._seats.people.pop(seat, None) is None:
            return []
        self._session.event("leave", seat=seat)
        lost = self._void("the connection of a person was lost") if self._lifts(seat) else []
        return lost or self._state()

    def receive(self, seat: int, message: str | bytes, now: float) -> list[Message]:
        """Return the answers to a page's message; an invalid message is answered by a fault.

        Parameters
        ----------
        seat
            The sender's seat.
        message
            JSON, or a binary message.
        now
            Time of the room's clock [s].
        """
        try:
            if isinstance(message, bytes):
                self._samples(seat, message, now)
                return []
            return self._control(seat, _object(message), now)
        except InputError as error:
            self._session.event("fault", seat=seat, message=str(error)[:400])
            return [(seat, json.dumps({"type": "fault", "message": str(error)}))]

    def _control(self, seat: int, content: dict[str, Any], now: float) -> list[Message]:
        kind = content.get("type")
        if kind == "ping":
            pong = {"type": "pong", "t": content.get("t"), "room": 1000 * now}
            return [(seat, json.dumps(pong))]
        if seat not in self._seats.people:
            raise InputError("only a person with a seat may do that")
        match kind:
            case "choose":
                return self._choose(seat, content)
            case "swap":
                return self._swap(seat)
            case "grip":
                return self._grip(seat, Grip.parse(content), now)
            case "release":
                return self._release(seat, "the hand let go")
            case "hidden":
                return self._release(seat, "the page was hidden")
            case "report":
                return self._report(seat, content)
        raise InputError(f"unknown type of message {kind!r:.40}")

    def _choose(self, seat: int, content: dict[str, Any]) -> list[Message]:
        if seat != 0 or self._lifting is not None:
            raise InputError("only the host may choose the partner, and not during a lift")
        self._choice, self._prepared = HostChoice.parse(content, self._policies, self._robot), False
        self._part()
        return self._state()

    def _swap(self, seat: int) -> list[Message]:
        if seat != 0 or self._lifting is not None:
            raise InputError("only the host may swap the ends, and not during a lift")
        self._seats.swapped = not self._seats.swapped
        self._part()
        return self._state()

    def _grip(self, seat: int, grip: Grip, now: float) -> list[Message]:
        if seat not in self._seats.ends(self._choice.partner):
            raise InputError("there is no end of the table for this person")
        if self._lifting is not None or not self._prepared:
            raise InputError("the partner is not ready, or a lift is under way")
        self._seats.people[seat].close(grip, now)
        grips = self._seats.grips(self._choice.partner)
        return self._state() if grips is None else self._begin(grips, now)

    def _release(self, seat: int, reason: str) -> list[Message]:
        if self._lifts(seat):
            return self._void(reason)
        self._seats.people[seat].grip = None
        return self._state()

    def _report(self, seat: int, content: dict[str, Any]) -> list[Message]:
        if self._last is None or content.get("lift") != self._last[0]:
            raise InputError(f"there is no lift {content.get('lift')!r:.40} to report on")
        self._session.report(self._last[1], seat, content)
        return []

    def _samples(self, seat: int, message: bytes, now: float) -> None:
        content, person = parse_samples(message), self._seats.people.get(seat)
        if self.due is None or self._lifting is None or person is None or person.grip is None:
            return  # The hand has just opened, or has closed before the other one.
        hand = self._lifting.hands[self._seats.ends(self._choice.partner).index(seat)]
        person.send(content, hand, now)

    def _lifts(self, seat: int) -> bool:
        """Return whether the person in a seat is in the middle of a lift."""
        return self.due is not None and seat in self._seats.ends(self._choice.partner)

    def _scenario(self) -> Scenario:
        place = self._session.played_with(self._choice.partner.name)
        cue = cue_of(self._cue_seed, place, self._choice.mixture)
        return live_scenario(cue, self._number, self._choice.partner.seat, self._choice.latency)

    def _begin(self, grips: Mapping[int, Grip], now: float) -> list[Message]:
        delay = self._seats.delay(self._choice.partner)
        scenario = self._scenario()
        try:
            self._lifting = Lifting(
                Lift(scenario),
                self._choice.partner,
                self._together(scenario.control_period).agent,
                grips,
                begin=now + AHEAD_S,
                delay=delay,
            )
        except EvaluatorFault as error:
            self._part()
            return self._void(f"the partner could not begin: {error_text(error)}")
        start = {
            "type": "start",
            "lift": self._number,
            "at": 1000 * self._lifting.begin,
            "frames": self._lifting.horizon,
            "delay": 1000 * delay,
            "playout": 1000 * self._lifting.playout,
        }
        # The leader expects the first goal; whoever follows is not told when it comes.
        leader = self._seats.ends(self._choice.partner)[0]
        first = {"type": "first", "frame": min(self._lifting.cues)}
        return [*self._state(), (ALL, json.dumps(start)), (leader, json.dumps(first))]

    def tick(self, now: float) -> list[Message]:
        """Make the frames that are due at ``now`` [s], and return the messages to the pages."""
        lifting = self._lifting
        if lifting is None:
            return []
        found: list[Message] = []
        ends = self._seats.ends(self._choice.partner)
        try:
            for end, message in lifting.messages(now):
                found.append((ends[end], message))
        except EvaluatorFault as error:
            self._part()
            return self._void(f"the partner's process ended: {error}")
        if lifting.punctuality.void:
            found += self._void(f"this machine was too busy: {lifting.punctuality}")
        elif now - max(self._seats.heard(self._choice.partner), lifting.begin) > SILENT_S:
            found += self._void(f"nothing was heard of a person's page for {SILENT_S:g} s")
        return found

    def _together(self, period: float) -> Partnership:
        """Return the partnership of the next lift."""
        if self._partnership is not None and self._partnership.over:
            self._part()
        if self._partnership is None:
            self._partnership = Partnership(self._choice.partner, period)
        return self._partnership

    def _part(self) -> None:
        """End the partnership: the next lift is the first with its partner."""
        if self._partnership is not None:
            self._partnership.close()
        self._partnership = None

    def _void(self, reason: str, **measured: Any) -> list[Message]:
        """End the lift without a result; it is repeated with the same cue."""
        self._let_go()
        self._session.event("void", lift=self._number, reason=reason[:400], **measured)
        void = {"type": "void", "lift": self._number, "reason": reason}
        return [(ALL, json.dumps(void)), *self._state()]

    def _let_go(self) -> None:
        if self._lifting is not None:
            self._lifting.close()
        self._lifting = None
        self._seats.let_go()

    def _end(self, lifting: Lifting) -> list[Message]:
        number = self._number
        run = lifting.run(f"live {number:03d}")
        goals = _goals(run)
        missed = missed_words(goals)
        if missed is not None:
            errors = {each.name: round(1000 * each.error, 1) for each in goals}
            return self._void(missed, goal_errors_mm=errors)
        self._let_go()
        folder = self._session.save(number, self._choice.partner.name, run)
        self._session.timing(folder, lifting.punctuality.late)
        self._last, self._number = (number, folder), self._session.next_number()
        failure = run.episodes[0].failure
        self._standing = None
        if not is_policy_failure(failure):  # Else there is no movement.
            self._standing = Standing(
                dataclasses.replace(run.suite.scenarios[0], partner=self._robot),
                self._policies,
                lag=lifting.lag,
            )
        rmse_mm = run.episodes[0].scores["rmse_mm"]
        session = self._counted(rmse_mm, failed=is_policy_failure(failure))
        end = {
            "type": "end",
            "lift": number,
            "rmse_mm": rmse_mm,
            "session": {"lifts": LIFTS, "rmse_mm": session},
            "goal_error_mm": goal_error_mm(goals) if goals else None,
            "failure": failure,
            "compared": self._standing is not None,
            "ghost_rmse_mm": ghost_rmse(lifting.cue, number),
            **lifting.quality(),
            "folder": f"{folder.parent.name}/{folder.name}",
        }
        return [(ALL, json.dumps(end)), *self._state()]

    def _counted(self, rmse_mm: float, *, failed: bool) -> list[float]:
        """Return the errors of the session with this lift; a policy that failed is made anew."""
        assert self._partnership is not None
        self._partnership.errors.append(rmse_mm)
        errors = [*self._partnership.errors]
        if failed:
            self._part()
        return errors

    def work(self) -> list[Message]:
        """Do some work between lifts: score the last one, warm up the partner, compare.

        The first decision of a policy takes a second, while libraries are loaded: it must not fall
        into a person's lift.
        """
        if self._lifting is not None:
            return self._end(self._lifting) if self._lifting.over else []
        if not self._prepared:
            try:
                rehearse(self._choice.partner, self._scenario())
            except EvaluatorFault as error:
                self._session.event("fault", message=error_text(error)[:400])
            self._prepared = True
            return self._state()
        if self._standing is None:
            return []
        told = self._standing.next()
        if told is None:
            return []
        self._standing = None
        assert self._last is not None
        return [(ALL, json.dumps({"type": "standing", "lift": self._last[0], **told}))]

    def _state(self) -> list[Message]:
        phase = "lifting" if self._lifting is not None else "waiting"
        if not self._prepared:
            phase = "preparing"
        room = {
            "partners": [*self._policies, SIMULATED, PERSON, PERSON_AS_ROBOT],
            "kind": self._choice.mixture,
            "latency_ms": round(1000 * self._choice.latency),
            "lift": self._number,
        }
        return self._seats.told(
            self._choice.partner, phase if self._prepared else "preparing", room
        )

    def close(self) -> None:
        """End the lift under way, and the partner."""
        if self._lifting is not None:
            if self._lifting.over:
                self._end(self._lifting)
            else:
                self._void("the room was closed")
        self._part()


def _goals(run: Run) -> tuple[GoalError, ...]:
    """Return the goal errors of a lift; none if it failed, since its goals were not all shown."""
    human = run.suite.scenarios[0].human
    if run.episodes[0].failure is not None or not isinstance(human, Played):
        return ()
    return lift_goal_errors(human)


def _object(message: str) -> dict[str, Any]:
    try:
        content = json.loads(message)
    except ValueError:
        content = None
    if not isinstance(content, dict):
        raise InputError("a message must be a JSON object")
    return content
