"""A network that acts alone, and one that does not, on the same observations."""

import numpy as np
import pytest
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.tasks.agree.observation import HURDLE_SENSES
from colift.agents.tasks.touch.alone_law import FURTHER, REACH, law_of, ports_of
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touch_controller import touch_network
from colift.agents.tasks.touch.touch_law import AHEAD, TouchNetwork, touch_at_rest


def network(alone):
    """Return a random network of the task ``agree``."""
    rng, units = np.random.default_rng(3), 4
    inputs, outputs = ports_of(HURDLE_SENSES, alone=alone)
    shapes = (3 * units, inputs), (3 * units, units), (3 * units,), (outputs, units + inputs)
    made = GatedNetwork(*map(rng.standard_normal, (*shapes, (outputs,))))
    return TouchNetwork("agree", HURDLE_SENSES, made, alone)


def departures(alone, change):
    """Return the departures from level in some steps in which what is felt is changed [m]."""
    learned, rng, found = network(alone), np.random.default_rng(1), []
    if alone:  # With its share at 0, it has no height of its own.
        learned.network.output[2], learned.network.output_bias[2] = 0.0, -100.0
    memory = touch_at_rest(learned)
    for _ in range(6):
        seen = 0.1 + 0.01 * rng.standard_normal(learned.expected)
        change(seen)
        last = memory.near * memory.begun
        memory, action = law_of(learned)(learned, memory, seen, PORTABLE)
        rise = memory.near - last if found else 0.0
        lead = FURTHER if alone else AHEAD
        found.append(action + seen[HapticObservation.HAND_COMMAND] - memory.near - lead * rise)
    return np.array(found)


def move_everybody(seen):
    """Lower both ends and the hand, and push."""
    for place in ("HUMAN_END", "ROBOT_END", "HAND_HEIGHT", "HAND_COMMAND"):
        seen[HapticObservation[place]] -= 0.03
    seen[HapticObservation.FORCE] += 2.0
    seen[HapticObservation.TORQUE] += 0.1


@pytest.mark.parametrize("alone", [True, False])
def test_only_a_network_with_a_partner_departs_from_level_for_it(alone):
    same, other = departures(alone, lambda seen: None), departures(alone, move_everybody)
    assert np.allclose(same, other, atol=1e-12) is alone


def test_who_acts_alone_can_go_to_a_height_of_its_own_whatever_the_partner_does():
    learned = network(True)
    learned.network.output[:], learned.network.output_bias[:] = 0.0, (0.0, 0.5, 100.0)
    for partner in (0.0, 0.2):
        seen = np.zeros(learned.expected)
        seen[HapticObservation.HUMAN_END] = partner
        _, action = law_of(learned)(learned, touch_at_rest(learned), seen, PORTABLE)
        assert action == pytest.approx(0.1 + 0.5 * REACH)


def test_a_file_of_weights_says_that_it_acts_alone():
    scales = np.array([(each.scale, each.rate) for each in HURDLE_SENSES])
    about = {"task": np.array("agree"), "scales": scales}
    felt, alone = ({**network(kind).network._asdict(), **about} for kind in (False, True))
    assert not touch_network(felt, "file").alone
    assert touch_network({**alone, "alone": np.array(True)}, "file").alone
