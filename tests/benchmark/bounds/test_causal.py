import numpy as np
from colift.agents.control.anticipation import load_anticipation
from colift.agents.loading.loading import PolicySpec
from colift.benchmark.bounds import held_out
from colift.benchmark.bounds.causal import BOUNDS, CAUSAL_BOUND, causal_bound
from colift.benchmark.comparison.playing import play_policies
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite


def seeds(model):
    first, last = model.provenance["seeds"]
    return range(first, last + 1)


def test_it_learned_from_other_people_than_the_policy_and_than_the_tests():
    bound, policy = causal_bound().model, load_anticipation()
    assert seeds(bound)[-1] < held_out.FIRST_SEED
    assert seeds(policy)[-1] < seeds(bound)[0]
    weights = [sum(w.size for w in model.perceptron.weights) for model in (bound, policy)]
    assert weights[0] > 3 * weights[1]


def test_the_bounds_stand_in_the_right_order():
    """The oracle knows most, then the causal bound; both are kept apart from the policies."""
    scenarios = tuple(make_scenario(name, "draw-200002") for name in ("jerky", "pause"))
    suite = Suite(name="few", scenarios=scenarios, seeds=(200_000, 200_001, 200_002))
    paired = play_policies({"blend": PolicySpec(text="blend")}, suite, bounds=BOUNDS)
    assert [policy.name for policy in paired.policies] == ["blend"]
    blend = np.mean([scores["rmse_mm"] for scores in paired.policies[0].scores])
    bound = paired.bounds[CAUSAL_BOUND]
    assert 10 * paired.bounds["oracle"].mean < bound.mean < 0.6 * blend
