import pickle

import numpy as np
from colift.agents.control.recurrent import shipped_network
from colift.agents.loading.loading import PolicySpec
from colift.benchmark.bounds.causal import BOUNDS, CAUSAL_BOUND, CausalBound, causal_bound
from colift.benchmark.comparison.playing import play_policies
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite


def test_the_bound_is_an_agent_of_its_own_weights():
    spec = CausalBound()
    with spec.agent() as agent:
        agent.reset(0)
        action = agent.act(np.array([0.01, 0.0, 0.0, 0.0, 0.0]))
    assert 0.0 < action[0] < 0.05
    assert spec.name == CAUSAL_BOUND
    assert spec.digest() == pickle.loads(pickle.dumps(spec)).digest()
    assert causal_bound().units >= shipped_network().units


def test_the_bounds_stand_in_the_right_order():
    """The oracle knows most, then the causal bound; both are kept apart from the policies."""
    scenarios = tuple(make_scenario(name, "draw-200002") for name in ("jerky", "pause"))
    suite = Suite(name="few", scenarios=scenarios, seeds=(200_000, 200_001, 200_002))
    specs = {name: PolicySpec(text=name) for name in ("anticipate", "learned")}
    paired = play_policies(specs, suite, bounds=BOUNDS)
    assert [policy.name for policy in paired.policies] == list(specs)
    errors = [np.mean([each["rmse_mm"] for each in found.scores]) for found in paired.policies]
    bound = paired.bounds[CAUSAL_BOUND]
    assert 10 * paired.bounds["oracle"].mean < bound.mean < min(errors)
