"""Results do not depend on the numerical code that the environment chooses."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from colift.agents.sandbox.host.levels import working_levels
from colift.benchmark.execution.provenance import fingerprint

pytestmark = pytest.mark.slow

FOUND = " ".join(np.show_config(mode="dicts")["SIMD Extensions"].get("found", ()))

KERNELS = {
    "OPENBLAS_CORETYPE=Haswell": {"OPENBLAS_CORETYPE": "Haswell"},
    "OPENBLAS_CORETYPE=Prescott": {"OPENBLAS_CORETYPE": "Prescott"},
    "no vector extensions": {"NPY_DISABLE_CPU_FEATURES": FOUND},
    "four threads": {f"{name}_NUM_THREADS": "4" for name in ("OMP", "OPENBLAS", "MKL")},
}

FIRST, *OTHERS = KERNELS

LIBM = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F"}
"""Makes the C library take other functions, which the engine uses, too."""

POLICY = """
import numpy as np

class Policy:
    def __init__(self):
        x = np.sin(np.arange(160000.0)).reshape(400, 400)
        self.mix = np.linalg.qr((x @ x)[:120, :120])[0]

    def reset(self, seed):
        self.estimate = np.zeros(120)

    def act(self, observation):
        seen = np.exp(np.resize(observation, 120))
        self.estimate = 0.5 * self.estimate + 0.5 * (self.mix @ (self.mix.T @ seen))
        return [0.5 * (np.log(self.estimate[0]) - observation[2])]
"""

OURS = """
import json
from colift.agents.humans import Subject
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import fingerprint, results
from colift.benchmark.results.baselines import SECOND_PERSON_SPEC
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
suite = make_suite("quick-v1").with_seeds(0, 1)
found = {"people": repr([Subject.draw(seed) for seed in range(20)])}
for policy in (PolicySpec(text="copy"), SECOND_PERSON_SPEC):
    played = suite.with_partner("human") if policy.name != "copy" else suite
    run = run_suite(policy, played)
    content = results(run, {}).plain()
    del content["summary"]["step_ms"], content["summary"]["real_time"]
    found[policy.name] = [[each.trace.digest(), repr(each.scores)] for each in run.episodes]
    found[policy.name + " in all"] = content
print(json.dumps([fingerprint()["linear_algebra"], found]))
"""

FOREIGN = """
import json, sys
from dataclasses import replace
from pathlib import Path
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
suite = make_suite("quick-v1").with_seeds(0, 1)
suite = replace(suite, scenarios=suite.scenarios[:2])
folder = Path(sys.argv[1])
specs = {"none": PolicySpec(text=f"{folder / 'policy.py'}:Policy")}
for level in sys.argv[2:]:
    place = f"{folder}/policy.py:Policy"
    specs[level] = SandboxedPolicy(name="mixed", origin=place, isolation=level)
found = {}
for name, spec in specs.items():
    run = run_suite(spec, suite)
    found[name] = [each.trace.digest() + str(each.failure) for each in run.episodes]
close_sandboxes()
print(json.dumps(found))
"""


def scrubbed():
    """Return the environment without what chooses numerical code."""
    chosen = ("OPENBLAS", "OMP", "MKL", "BLIS", "NPY", "GLIBC_TUNABLES")
    return {name: value for name, value in os.environ.items() if not name.startswith(chosen)}


def said(program, *arguments, **environment):
    done = subprocess.run(
        [sys.executable, "-c", program, *arguments],
        env={**scrubbed(), **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def plain():
    return said(OURS)


@pytest.mark.parametrize(
    "kernel", [FIRST, *(pytest.param(name, marks=pytest.mark.slow) for name in OTHERS)]
)
def test_humans_world_and_scores_have_the_same_bits(plain, kernel):
    name, found = said(OURS, **KERNELS[kernel])
    assert found == plain[1]
    if kernel.startswith("OPENBLAS") and plain[0].startswith("openblas"):
        assert name.split()[:2] == plain[0].split()[:2]
        assert name != plain[0] or name.endswith(kernel.partition("=")[2])


@pytest.mark.skipif(
    not fingerprint()["machine"].endswith("x86_64")
    or "X86_V3" not in fingerprint()["vector_extensions"],
    reason="the C library has no other functions for this processor",
)
def test_other_functions_of_the_c_library_are_another_platform():
    program = (
        "import json; from colift.benchmark.bundle import fingerprint as f; print(json.dumps(f()))"
    )
    here, there = said(program), said(program, **LIBM)
    assert {name for name in here if here[name] != there[name]} == {"libm"}


@pytest.fixture
def folder(tmp_path):
    """Return the folder of a policy that uses linear algebra."""
    folder = tmp_path / "mixed"
    folder.mkdir()
    (folder / "policy.py").write_text(POLICY)
    return folder


@pytest.mark.parametrize("kernel", [*KERNELS, "libm"])
def test_a_policy_has_the_same_bits_in_a_sandbox(folder, kernel):
    found = said(FOREIGN, str(folder), *working_levels(), **KERNELS.get(kernel, LIBM))
    assert all(digests == found["none"] for digests in found.values())
    assert "None" in found["none"][0]


def command(folder, *arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "colift.cli", *arguments],
        cwd=folder,
        env={**scrubbed(), **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.skipif(
    not fingerprint()["linear_algebra"].startswith("openblas"), reason="NumPy has another BLAS"
)
@pytest.mark.parametrize(("policy", "there"), [("copy", True), ("mixed/policy.py:Policy", False)])
def test_a_bundle_is_verified_with_another_kernel_to_the_bit(folder, policy, there):
    kernel = {"OPENBLAS_CORETYPE": "Prescott"}
    one, other = (kernel, {}) if there else ({}, kernel)
    options = ("--suite", "quick-v1", "--seeds", "0:1", "--out", "bundle")
    made = command(folder.parent, "run", policy, *options, **one)
    assert made.returncode == 0, made.stderr
    verified = command(folder.parent, "verify", "bundle", **other)
    assert verified.returncode == 0, verified.stderr
    assert "equal to the bit" in verified.stdout
    assert "bundle is verified." in verified.stdout
    assert "linear_algebra: openblas" in verified.stdout
    assert "may act otherwise in the last bits" in verified.stdout
    again = command(folder.parent, "verify", "bundle", **one)
    assert "may act otherwise" not in again.stdout
