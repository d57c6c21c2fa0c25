"""Random damage to a bundle: refused, or it changes nothing that is claimed; never a traceback."""

import copy
import dataclasses
import json

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import FILES, parse, read_bundle, read_files, results, write_bundle
from colift.benchmark.bundle.json_text import dump_json
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.verification import verify

from .forging import SUITE, mend

ROUNDS = 25
"""Changes of each file; thousands were tried when this was written."""

HOSTILE = [
    *(None, True, 0, -1, 1.5, -0.0, 2**63, 10**30, 1e308, 5e-324),
    *("", "../../../etc/passwd", "\x1b[2J\n\u202e", "a" * 5000),
    *([], [[]], {}, {"": {"a": [None]}}, [1, 2, 3]),
]
"""Values that nobody expects in a JSON file."""


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Return the files of a true bundle of one lift."""
    one = dataclasses.replace(SUITE, name="one", scenarios=SUITE.scenarios[:1], seeds=(3,))
    run = run_suite(PolicySpec(text="copy"), one)
    folder = tmp_path_factory.mktemp("fuzz") / "bundle"
    write_bundle(folder, run, results(run, {}).plain())
    return read_files(folder)


def claims(bundle):
    """Return all that a bundle claims and a verification can tell, in every bit."""
    content = copy.deepcopy(bundle.results)
    for name in ("colift", "policy", "isolation", "evaluator_faults"):
        del content[name]
    for name in ("step_ms", "real_time"):
        del content["summary"][name]
    episodes = [
        (
            *(each.behaviour, each.subject, each.trial, each.seed, each.failure),
            repr(each.scores),
            dataclasses.replace(each.trace, internals={}).digest(),
        )
        for each in bundle.episodes
    ]
    return content, bundle.indices, bundle.run().suite.digest, episodes


def assert_refused_or_harmless(folder, files, changed, *, mended):
    for name, data in {**files, **changed}.items():
        (folder / name).write_bytes(data)
    if mended and "manifest.json" not in changed:
        mend(folder)
    verdict = verify(folder)
    json.dumps(verdict.plain(), allow_nan=False)
    assert all(str(finding).isprintable() for finding in verdict.findings)
    if verdict.ok:
        assert claims(read_bundle(folder)) == claims(parse(files))
    else:
        assert verdict.findings or verdict.rescorable


@pytest.mark.parametrize("mended", [False, True])
@pytest.mark.parametrize("name", FILES)
def test_changed_bytes(tmp_path, files, name, mended):
    rng = np.random.default_rng([FILES.index(name), mended])
    for number in range(ROUNDS):
        data = bytearray(files[name])
        for place in rng.integers(len(data) - 3, size=rng.integers(1, 4)).tolist():
            if number % 3 == 0:
                data[place] ^= 1 << int(rng.integers(8))
            elif number % 3 == 1:
                data[place] = int(rng.integers(256))
            else:
                del data[place]
        assert_refused_or_harmless(tmp_path, files, {name: bytes(data)}, mended=mended)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["results.json", "manifest.json"])
def test_values_of_another_kind(tmp_path, files, name):
    rng = np.random.default_rng(FILES.index(name))
    for _ in range(2 * ROUNDS):
        content = json.loads(files[name])
        inner = content
        while True:
            keys = [*inner] if isinstance(inner, dict) else [*range(len(inner))]
            key = keys[rng.integers(len(keys))]
            if not (isinstance(inner[key], dict | list) and inner[key] and rng.random() < 0.8):
                break
            inner = inner[key]
        inner[key] = HOSTILE[rng.integers(len(HOSTILE))]
        changed = {name: dump_json(content)}
        assert_refused_or_harmless(tmp_path, files, changed, mended=True)
