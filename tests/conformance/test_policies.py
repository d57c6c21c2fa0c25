"""The conformance check of policies: a plain one passes, and each rule is enforced."""

import numpy as np
import pytest
from colift.testing import check_policy


class Follow:
    """Follows the table; each bad policy changes one thing of it."""

    def reset(self, seed):
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        return np.array([0.3 * (observation[0] - observation[3])])


class Writes(Follow):
    def act(self, observation):
        action = super().act(observation)
        observation[0] = 0.0
        return action


class Remembers(Follow):
    total = 0.0

    def reset(self, seed):
        pass

    def act(self, observation):
        self.total += observation[0]
        return np.array([self.total])


class Shares(Follow):
    heights = np.zeros(1)

    def reset(self, seed):
        self.heights[:] = 0.0

    def act(self, observation):
        self.heights[0] += observation[0]
        return self.heights.copy()


class TwoNumbers(Follow):
    def act(self, observation):
        return np.zeros(2)


class Infinite(Follow):
    def act(self, observation):
        return np.array([np.inf])


class Reuses(Follow):
    def __init__(self):
        self.action = np.zeros(1)

    def act(self, observation):
        self.action[0] = observation[0]
        return self.action


class Mumbles(Follow):
    def internals(self):
        return {f"at {self.steps}": 1.0}


class Overconfident(Follow):
    def internals(self):
        return {"confidence": 2.0}


BAD_POLICIES = {
    Writes: "leave the observation unchanged",
    Remembers: "reset must clear",
    Shares: "must not share state",
    TwoNumbers: "policy TwoNumbers: .* must be 1 number",
    Infinite: "must be finite",
    Reuses: "must not change after",
    Mumbles: "the same names",
    Overconfident: r"confidence must be in \[0, 1\]",
}


def test_a_plain_policy_conforms():
    check_policy(Follow)


@pytest.mark.parametrize(("policy", "rule"), BAD_POLICIES.items(), ids=lambda x: str(x)[:40])
def test_a_policy_that_breaks_a_rule_is_refused(policy, rule):
    with pytest.raises(AssertionError, match=rule):
        check_policy(policy)


class Silent(Follow):
    def act(self, observation):
        pass


class Speaks(Follow):
    def act(self, observation):
        return "up"


class Raises(Follow):
    def act(self, observation):
        return observation.nothing


class Unmade(Follow):
    def __init__(self):
        raise ValueError("no weights")


class Actless:
    def reset(self, seed):
        pass


class Unpacks(Follow):
    def act(self, observation):
        *_, last, sixth = observation[4:]
        return last + sixth


@pytest.mark.parametrize(
    ("policy", "rule"),
    [
        (Silent, "policy Silent: the robot's action must be 1 number, got None"),
        (Speaks, "action must be 1 number, got 'up'"),
        (Raises, r"policy Raises raised AttributeError: .*test_policies.py:\d+"),
        (Unmade, "policy Unmade: its constructor raised ValueError: no weights"),
        (Actless, r"policy Actless has no method act\(\)"),
        (
            Unpacks,
            r"not enough values .*; if it plays another task, .*check_policy\(Policy, task\)",
        ),
        (Follow(), "a class, or a function that makes a policy, got an object of Follow"),
    ],
)
def test_a_policy_that_cannot_act_is_refused_in_words(policy, rule):
    with pytest.raises(AssertionError, match=rule):
        check_policy(policy)
