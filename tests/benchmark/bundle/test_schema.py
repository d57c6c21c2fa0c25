"""The JSON Schema of ``results.json``."""

import copy
import json
from collections.abc import Iterator

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.bundle.schema import results_schema
from colift.benchmark.episode.metric import Metric, metric_table
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import play_baselines
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.table import LEVEL_METRICS
from jsonschema import Draft202012Validator

VALIDATOR = Draft202012Validator(results_schema())


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    """Return the ``results.json`` of a fresh bundle, with baselines."""
    suite = make_suite("quick-v1")
    run = run_suite(PolicySpec(text="hold"), suite)
    folder = tmp_path_factory.mktemp("bundle") / "hold"
    write_bundle(folder, run, results(run, play_baselines(suite)).plain())
    return json.loads((folder / "results.json").read_text())


def objects(content: object) -> Iterator[dict[str, object]]:
    """Yield every object in a JSON content, the outer ones first."""
    if isinstance(content, dict):
        yield content
    for each in content.values() if isinstance(content, dict) else content:
        if isinstance(each, dict | list):
            yield from objects(each)


def test_it_is_a_schema():
    Draft202012Validator.check_schema(results_schema())


def test_a_fresh_bundle_is_valid(content):
    assert content["baselines"].keys() == {"human_human", "hold", "copy"}
    VALIDATOR.validate(content)


def test_a_bundle_without_baselines_is_valid(hostile):
    VALIDATOR.validate(json.loads((hostile / "results.json").read_text()))


def test_an_added_key_is_invalid_in_every_object(content):
    count = len(list(objects(content)))
    assert count > 50
    for place in range(count):
        changed = copy.deepcopy(content)
        list(objects(changed))[place]["added"] = 1
        assert not VALIDATOR.is_valid(changed)


def test_a_missing_key_is_invalid_in_every_object(content):
    for place, original in enumerate(objects(content)):
        if original is content["baselines"]:
            continue
        for name in original:
            changed = copy.deepcopy(content)
            del list(objects(changed))[place][name]
            assert not VALIDATOR.is_valid(changed), name


@pytest.mark.parametrize(
    ("name", "value"), [("scoring", 1.5), ("complete", "yes"), ("policy", "hold"), ("groups", {})]
)
def test_a_value_of_another_type_is_invalid(content, name, value):
    assert not VALIDATOR.is_valid({**content, name: value})


def test_a_task_with_another_metric_has_a_schema_with_it():
    own = Metric(
        name="own", symbol="own", label="Own", better="less", shown="run", meaning="a share"
    )
    schema = results_schema(metric_table((*LEVEL_METRICS.values(), own)))
    assert "own" in schema["properties"]["summary"]["required"]
    assert "own" not in results_schema()["properties"]["summary"]["required"]
