import dataclasses

import numpy as np
import pytest
from colift.agents.control.anticipation import FeatureWindow, load_anticipation
from colift.agents.policies.anticipate import AnticipateParameters
from colift.benchmark.references.ablation import VARIANTS, ablate, moving, narrowed, variants
from colift.benchmark.references.anticipation_spec import AnticipationSpec
from colift.benchmark.references.held_out import held_out_suite
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.anticipation import Lesson, learn_anticipation
from colift.benchmark.training.data import TrainingData, window_inputs
from colift.benchmark.training.population import CURRICULUM, SETTLED


def test_narrower_experience_is_what_a_narrower_window_sees():
    rng = np.random.default_rng(0)
    human = rng.normal(0.0, 0.1, 40)
    wide, narrow = FeatureWindow(), FeatureWindow(velocities=4)
    data = TrainingData(
        inputs=window_inputs(human, wide),
        outcomes=np.zeros((40, 2), np.float32),
        seeds=np.arange(40),
    )
    assert narrowed(data, narrow).inputs == pytest.approx(window_inputs(human, narrow))
    assert narrowed(data, wide).inputs == pytest.approx(data.inputs)
    assert moving(data, BEHAVIOURS).seeds.tolist() == [i for i in range(40) if i % 8 < 4]
    assert moving(data, SETTLED).seeds.tolist() == [i for i in range(40) if i % 8 < 5]
    unsettled = (*BEHAVIOURS, "unsettled")
    assert moving(data, unsettled).seeds.tolist() == [i for i in range(40) if i % 8 != 4]
    assert moving(data, CURRICULUM) is data


def test_each_variant_lacks_one_part():
    for variant in VARIANTS:
        lacks = [bool(variant.window), bool(variant.parameters), variant.first_round]
        lacks.append(variant.only != CURRICULUM)
        assert sum(lacks) + (variant.hidden == ()) == 1, variant
        AnticipateParameters(**variant.parameters)
        dataclasses.replace(FeatureWindow(), **variant.window)
    assert len({variant.name for variant in VARIANTS}) == len(VARIANTS)


def test_variants_are_learned_from_what_the_whole_was_learned_from():
    pytest.importorskip("sklearn")
    first, last = learn_anticipation(lifts=3, rounds=2, first_seed=100_300)
    whole, *others = variants(first, last)
    assert whole.model is last.model
    found = dict(zip((variant.name for variant in VARIANTS), others, strict=True))
    assert found["the longer history: 0.4 s instead of 2 s"].model.window.velocities == 4
    assert found["the second training round"].model is first.model
    assert found["the cost on changes of slope"].parameters.smoothness == 0.0
    line = next(robot for name, robot in found.items() if "linear" in name)
    assert len(line.model.perceptron.weights) == 1
    assert isinstance(last, Lesson)


def test_what_a_part_is_worth_is_a_paired_difference():
    suite = Suite(
        name="few",
        scenarios=(make_scenario("smooth", "draw-200003"),),
        seeds=held_out_suite(1, 3).seeds,
    )
    model = load_anticipation()
    robots = (
        AnticipationSpec(name="whole", model=model),
        AnticipationSpec(name="late", model=model, parameters=AnticipateParameters(arm_lag=0.0)),
        AnticipationSpec(
            name="rough", model=model, parameters=AnticipateParameters(smoothness=0.0)
        ),
        AnticipationSpec(name="same", model=model),
    )
    whole, late, rough, same = ablate(iter(robots), suite)
    assert whole.worse_mm is None
    assert late.worse_mm.mean == pytest.approx(late.rmse_mm - whole.rmse_mm)
    assert late.worse_mm.mean > 0.0
    assert rough.rougher.mean == pytest.approx(whole.sparc - rough.sparc)
    assert rough.rougher.mean > 0.0
    assert same.worse_mm.mean == same.rougher.mean == 0.0
