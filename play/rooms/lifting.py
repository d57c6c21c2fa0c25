"""A lift under way: hands, frames at their times, and the evidence at its end."""

import dataclasses
import json
from collections.abc import Mapping
from typing import Any

from colift.agents.agent import FRAME, Agent
from colift.agents.humans import Cued, Hand, PersonAsRobot, Played
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run
from colift.benchmark.real_lifts.suites import SEED
from colift.benchmark.suites.suite import Suite
from colift.play.rooms.choice import LIVE_DIGEST, LivePartner
from colift.play.rooms.grip import Grip
from colift.play.rooms.hand import LiveHand
from colift.play.rooms.live_lift import LiveLift
from colift.play.rooms.messages import LATE, STARVED, dump_frame
from colift.play.rooms.punctuality import Punctuality


class Lifting:
    """One lift of real people, made frame by frame at the times that the room's clock gives.

    Parameters
    ----------
    lift
        The lift of the scenario.
    partner
        The holder of the far end.
    agent
        The partner's agent; None if a second person acts.
    grips
        The closed hand of each end that a person holds: 0 the human's, 1 the far one.
    begin
        Time of the room's clock at which frame 0 begins [s].
    delay
        Playout delay of the samples [s].
    """

    def __init__(
        self,
        lift: Lift,
        partner: LivePartner,
        agent: Agent | None,
        grips: Mapping[int, Grip],
        *,
        begin: float,
        delay: float,
    ) -> None:
        self.begin = begin
        self.delay = delay
        self.playout = max(grip.playout for grip in grips.values())
        """Delay with which all pages show the frames [s]."""
        self.punctuality = Punctuality(period=FRAME)
        self.hands = {
            end: LiveHand(grip.offset - begin, delay) for end, grip in sorted(grips.items())
        }
        self._lift = lift
        self._partner = partner
        self._scenario = lift.scenario
        far = self.hands.get(1)
        holder: Agent | Hand
        if agent is not None:
            holder = agent
        elif far is not None and lift.seat.is_robot:
            holder = PersonAsRobot(far, lift.frames_per_step, lift.scenario.control_period)
        else:
            holder = self.hands[1]
        self._live = LiveLift(lift, SEED, self.hands[0], holder)
        self._made = 0
        cue = lift.scenario.human
        assert isinstance(cue, Cued)
        self.cue = cue
        self.cues = {each.frame: each.height for each in cue.cues()}

    @property
    def horizon(self) -> int:
        """Frames of the whole lift."""
        return self._live.lift.horizon

    @property
    def lag(self) -> float:
        """Delay that a network adds between the hand and the picture of a second person [s]."""
        return self.delay + self.playout if len(self.hands) > 1 else 0.0

    @property
    def over(self) -> bool:
        """Whether the lift has ended."""
        return self._live.over

    @property
    def due(self) -> float:
        """Time of the room's clock at which the next frame is to be made [s]."""
        return self.begin + (self._made + 1) * FRAME

    def messages(self, now: float) -> list[tuple[int, str | bytes]]:
        """Make the frames that are due; late ones are caught up and counted.

        Returns
        -------
        list of (int, str or bytes)
            For each frame a binary message to each end that a person holds; and, when a cue
            appears, a JSON message to the human's end.

        Raises
        ------
        EvaluatorFault
            If the policy's process ended without a fault of the policy.
        """
        found: list[tuple[int, str | bytes]] = []
        lateness, before = now - self.due, self._made
        while not self.over and self.due <= now:
            late = LATE if now - self.due > FRAME else 0
            shown = self._live.frame()
            if shown is None:
                break
            self._made += 1
            for end, hand in self.hands.items():
                flags = late | (STARVED if hand.starving else 0)
                found.append((end, dump_frame(shown, flags=flags, used=hand.used)))
            height = self.cues.get(shown.frame)
            if height is not None:
                cue = {"type": "cue", "frame": shown.frame, "height": height}
                found.append((0, json.dumps(cue)))
        if self._made > before:
            self.punctuality.count(lateness, self._made - before)
        return found

    def finish(self) -> tuple[Scenario, Episode]:
        """Return the scenario with the recorded hands, and the outcome."""
        far = self.hands.get(1)
        human = Played(
            cue=self.cue, log=self.hands[0].log(), far=None if far is None else far.log()
        )
        return dataclasses.replace(self._scenario, human=human), self._live.outcome()

    def run(self, name: str) -> Run:
        """Return the finished lift as a run of one episode, on a suite of that name."""
        scenario, episode = self.finish()
        spec = self._partner.spec
        return Run(
            policy=self._partner.name,
            policy_digest=LIVE_DIGEST if spec is None else spec.digest(),
            suite=Suite(name=name, scenarios=(scenario,), seeds=(SEED,)),
            episodes=(episode,),
            isolation="none" if spec is None else spec.isolation,
        )

    def quality(self) -> dict[str, Any]:
        """Return measures of the lateness of frames and of the gaps in the hands' samples."""
        return {
            "lag_ms": round(1000 * self.lag, 3),
            "late": {
                "frames": self.punctuality.frames,
                "worst_ms": round(1000 * self.punctuality.worst, 3),
                "marked": self.punctuality.marked,
            },
            "starved": [hand.starved for hand in self.hands.values()],
            "refused": [hand.refused for hand in self.hands.values()],
        }

    def close(self) -> None:
        """Release the world."""
        self._lift.close()
