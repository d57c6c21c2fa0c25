"""A network that is blind to its partner, and one that is not, on the same observations."""

import numpy as np
import pytest
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.tasks.agree.observation import HURDLE_SENSES
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touch_controller import touch_network
from colift.agents.tasks.touch.touch_law import (
    TouchNetwork,
    felt_action,
    inputs_of,
    touch_at_rest,
)


def network(alone):
    """Return a random network of the task ``agree``."""
    rng, units, inputs = np.random.default_rng(3), 4, inputs_of(HURDLE_SENSES)
    shapes = ((3 * units, inputs), (3 * units, units), (3 * units,), (1, units + inputs), (1,))
    return TouchNetwork(
        "agree", HURDLE_SENSES, GatedNetwork(*map(rng.standard_normal, shapes)), alone
    )


def departures(alone, change):
    """Return the departures from level in some steps in which the partner is changed [m]."""
    learned, rng, found = network(alone), np.random.default_rng(1), []
    memory = touch_at_rest(learned)
    for _ in range(6):
        seen = 0.1 + 0.01 * rng.standard_normal(learned.expected)
        change(seen)
        last = memory.near * memory.begun
        memory, action = felt_action(learned, memory, seen, PORTABLE)
        rise = memory.near - last if found else 0.0
        lead = 2.2 if alone else 1.2
        found.append(action + seen[HapticObservation.HAND_COMMAND] - memory.near - lead * rise)
    return np.array(found)


def lower_the_partner(seen):
    """Lower the other end, and push the hands."""
    seen[HapticObservation.HUMAN_END] -= 0.03
    seen[HapticObservation.FORCE] += 2.0
    seen[HapticObservation.TORQUE] += 0.1


@pytest.mark.parametrize("alone", [True, False])
def test_only_a_network_with_a_partner_departs_from_level_for_it(alone):
    same, other = departures(alone, lambda seen: None), departures(alone, lower_the_partner)
    assert np.allclose(same, other, atol=1e-12) is alone


def test_a_file_of_weights_says_that_it_is_blind_to_its_partner():
    weights = {**network(True).network._asdict(), "task": np.array("agree")}
    scales = np.array([(each.scale, each.rate) for each in HURDLE_SENSES])
    assert not touch_network({**weights, "scales": scales}, "file").alone
    assert touch_network({**weights, "scales": scales, "alone": np.array(True)}, "file").alone
