"""The people of a room: their seats, their hands, and the messages to each."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from colift.base.errors import InputError
from colift.play.rooms.choice import PERSON, PERSON_AS_ROBOT, SIMULATED, LivePartner
from colift.play.rooms.grip import FIRST_DELAY_S, LONGEST_DELAY_S, Grip
from colift.play.rooms.hand import LiveHand
from colift.play.rooms.messages import HandSamples

ALL: Final = 255
"""Stand-in for every seat in a message to the pages."""

Message = tuple[int, str | bytes]
"""A seat, and the message to it: JSON or binary."""

SPARE_S: Final = 0.002
"""Added to the playout delay that sufficed for 99 of 100 messages [s]."""

LEAST_MESSAGES: Final = 50
"""Fewest messages of a moving hand from which its playout delay is learned."""

HOLD_STILL: Final = "Hold still: a line will appear."
"""What the leader is told until the first goal appears."""

ROLES: Final = ("leader", "follower")
ENDS: Final = ("human", "far")


@dataclass(kw_only=True)
class SeatedPerson:
    """A person in a seat."""

    grip: Grip | None = None
    """Grip of the closed hand; None if it is open."""
    delays: dict[str, float] = field(default_factory=dict)
    """Learned playout delay of each preset [s]."""
    expected: int = 0
    """Number of the next sample since the grip."""
    last: tuple[float, float] | None = None
    """The newest sample of the present lift."""
    heard: float = 0.0
    """Time when samples last came, or the hand was closed [s]."""
    needed: list[float] = field(default_factory=list)
    """Playout delay with which each message of a moving hand would have been in time [s]."""

    @property
    def delay(self) -> float:
        """Playout delay that the person's input and connection need [s]."""
        assert self.grip is not None
        return self.delays.get(self.grip.preset, FIRST_DELAY_S[self.grip.preset])

    def close(self, grip: Grip, now: float) -> None:
        """Close the hand."""
        self.grip, self.heard = grip, now
        self.expected, self.last, self.needed = 0, None, []

    def send(self, content: HandSamples, hand: LiveHand, now: float) -> None:
        """Give a page's samples to the hand.

        Raises
        ------
        InputError
            If samples before these are missing, or these have already come.
        """
        if self.grip is None or content.first != self.expected:
            raise InputError(
                f"sample {self.expected} must be next, got {content.first}: one is missing, or "
                "was sent twice"
            )
        self.expected += len(content.samples)
        self.heard = now
        for time, height in content.samples:
            hand.add(time, height)
        if not content.samples:
            return
        # Before this message, the hand was known only up to the end of the last one. Frames made in
        # between held its last height, which is right if the hand did not move.
        if self.last is not None and self.last[1] != content.samples[0][1]:
            self.needed.append(now - self.last[0] - self.grip.offset)
        self.last = content.samples[-1]

    def let_go(self) -> None:
        """Open the hand; learn the lateness of samples from the lift."""
        if self.grip is not None and len(self.needed) >= LEAST_MESSAGES:
            most = sorted(self.needed)[int(0.99 * (len(self.needed) - 1))]
            self.delays[self.grip.preset] = min(max(most + SPARE_S, 0.0), LONGEST_DELAY_S)
        self.grip, self.needed = None, []


class Seats:
    """The seats of a room: 0 is the host's, 1 that of a second person."""

    def __init__(self) -> None:
        self.people: dict[int, SeatedPerson] = {}
        self.swapped = False
        """Whether the second person leads."""

    def ends(self, partner: LivePartner) -> list[int]:
        """Return the seats of the people who lift: the human's end, then the far one."""
        if partner.people == 1:
            return [0]
        return [1, 0] if self.swapped else [0, 1]

    def grips(self, partner: LivePartner) -> dict[int, Grip] | None:
        """Return the closed hand of each end (0, 1) that a person holds; None if one is open."""
        found: dict[int, Grip] = {}
        for end, seat in enumerate(self.ends(partner)):
            person = self.people.get(seat)
            if person is None or person.grip is None:
                return None
            found[end] = person.grip
        return found

    def delay(self, partner: LivePartner) -> float:
        """Return the playout delay of all hands [s]: that of the slower connection."""
        people = [self.people[seat] for seat in self.ends(partner)]
        wished = [each.grip.delay for each in people if each.grip and each.grip.delay is not None]
        return max(wished or [each.delay for each in people])

    def heard(self, partner: LivePartner) -> float:
        """Return the time of the last message of the page that has been silent for longest [s]."""
        return min(self.people[seat].heard for seat in self.ends(partner))

    def let_go(self) -> None:
        """Open all hands."""
        for person in self.people.values():
            person.let_go()

    def told(self, partner: LivePartner, phase: str, room: dict[str, Any]) -> list[Message]:
        """Return the messages with the state of the room for each person, and their place in it."""
        ends = self.ends(partner)
        closed = [seat in self.people and self.people[seat].grip is not None for seat in ends]
        if phase == "waiting" and all(seat in self.people for seat in ends):
            phase = "ready"
        found: list[Message] = []
        for seat in self.people:
            place = ends.index(seat) if seat in ends else None
            state = {
                "type": "state",
                "phase": phase,
                "partner": partner.name,
                "you": "spectator" if place is None else ENDS[place],
                "role": None if place is None else ROLES[place],
                "people": len(self.people),
                "needed": partner.people,
                "gripped": closed,
                "message": _sentence(phase, partner, place, closed),
                **room,
            }
            found.append((seat, json.dumps(state)))
        return found


def watched_sentence(phase: str, partner: str) -> str:
    """Return a sentence on what the people wait for, as a spectator is told it."""
    return {
        "preparing": _preparing(partner),
        "lifting": "They lift.",
        "waiting": "The second person is not here yet.",
    }.get(phase, "The next lift begins when they take hold.")


def _preparing(partner: str) -> str:
    """Return a sentence on who or what is not ready yet, with a partner of that name."""
    who = {SIMULATED: "The simulated person", PERSON: "The table", PERSON_AS_ROBOT: "The robot"}
    return f"{who.get(partner, partner)} is getting ready."


def _sentence(phase: str, partner: LivePartner, end: int | None, closed: Sequence[bool]) -> str:
    """Return a sentence on what the person at an end (0, 1) does or waits for."""
    if phase == "preparing":
        return _preparing(partner.name)
    if phase == "lifting":
        return HOLD_STILL if end == 0 else "Follow the table."
    if phase == "waiting":
        return "Waiting for the second person: send them the link."
    if end is not None and closed[end]:
        return "Hold still: the other hand is still open."
    if partner.people == 2:
        return "Take hold of the table, both of you."
    return "Take hold of the table."
