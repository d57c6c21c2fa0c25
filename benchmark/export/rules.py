"""The fixed sets for offline learning: their agents, and the conclusions that each set allows."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from colift.agents.agent import Agent
from colift.agents.loading.policy_spec import PolicySpec, source_digest
from colift.agents.policies.anticipate import Anticipate
from colift.base.errors import InputError
from colift.benchmark.export.agents import Clipped, Follower, SeededPartner

EXPERT: Final = "anticipate"


@dataclass(frozen=True, kw_only=True)
class SetRule:
    """The rule of a fixed set."""

    agents: tuple[str, ...]
    """Agents at the robot's end, in turn from lift to lift: names of :func:`agent`."""
    about: str
    """The set in a sentence or two."""
    shows: tuple[str, ...]
    """Sentences on the conclusions that the set allows, and those that it does not."""
    human: bool = False
    """Whether a second human holds the robot's end, converted if the set has only this end."""
    recorded: bool = False
    """Whether people move as in recordings, which the user provides."""


_FOLLOW: Final = (
    "Every robot here lags. A clone lags as much; to do better, a learner has to combine the "
    "people's motion, which is the same whoever follows, with other actions than those it saw."
)
_PEOPLE: Final = (
    "The human's path hardly depends on the robot. A model of that path is worth more than a value "
    "function here, and a set of other tasks may rank methods differently."
)
_SCORE: Final = (
    "It has people of training only. Score a policy by `colift run`: `standard-v1` has people and "
    "seeds that are not here, and a board has hidden ones."
)

RULES: Final[Mapping[str, SetRule]] = {
    "follow": SetRule(
        agents=("follow",),
        about="Robots that follow the seen height, between `copy` and `proportional`, with a gain "
        "of each lift's own and noise on it.",
        shows=(_FOLLOW, _PEOPLE, _SCORE),
    ),
    "human": SetRule(
        agents=("human",),
        about="Teams of two simulated people, one of them at the robot's end.",
        shows=(
            "A person's arm is softer than a robot's: on a robot the same references lead "
            "elsewhere, and a value function learned here is about a person's arm.",
            _SCORE,
        ),
        human=True,
    ),
    "mixed": SetRule(
        agents=("follow", "expert"),
        about="Lifts of `follow` and of `expert` in turn.",
        shows=(
            "A learner that can tell good actions from bad ones should come near `expert`; a clone "
            "ends between the two.",
            _PEOPLE,
            _SCORE,
        ),
    ),
    "expert": SetRule(
        agents=("expert",),
        about="Lifts with `anticipate`, which plans by a learned forecast of the human's motion.",
        shows=(
            "A clone can come near its teacher, which has seen more than the five numbers of one "
            "step: the history of a second is needed.",
            "There is little to see beside good actions, so that little can be learned about bad "
            "ones.",
            _SCORE,
        ),
    ),
    "recorded": SetRule(
        agents=("follow", "expert"),
        about="Real people's recorded motion, with robots of `follow` and of `expert` in turn; "
        "each lift with a new simulated arm.",
        shows=(
            "The motion is recorded and does not react to the robot, but for the arm that gives "
            "way. Trials repeat when there are fewer than lifts.",
            "A policy that was trained on it has met these people: do not score it on the same "
            "recordings.",
        ),
        recorded=True,
    ),
}

CONVERTED: Final = (
    "The second person is shown as a robot: with the robot's senses, and the change of the hand's "
    "reference in a step as the action. The person saw and felt more than that. These actions do "
    "not replay; the references of `--view both` do."
)
"""Further sentences on a set in which a human is shown as a robot."""

NAMES: Final[Mapping[str, str]] = {
    "follow": "copy..proportional, noisy",
    "expert": EXPERT,
    "human": "human_human",
}
"""Names of the agents in the metadata of lifts."""


def rule(name: str) -> SetRule:
    """Return the rule of a set.

    Raises
    ------
    InputError
        If there is no such set; the message lists them.
    """
    if name not in RULES:
        raise InputError(f"unknown set {name!r:.80}; known: {', '.join(RULES)}")
    return RULES[name]


def agent(kind: str, seed: int) -> Agent:
    """Return an agent of a set.

    Parameters
    ----------
    kind
        ``follow``, ``expert`` or ``human``.
    seed
        The lift's seed.
    """
    if kind == "follow":
        return Follower(seed)
    if kind == "human":
        return SeededPartner(seed)
    return Clipped(PolicySpec(text=EXPERT).make())


def digest(kind: str) -> str:
    """Return the hash of an agent's code."""
    sources = {"follow": Follower, "human": SeededPartner, "expert": Anticipate}
    return source_digest(sources[kind])
