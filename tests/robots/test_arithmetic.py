"""Products and functions whose bits depend on nothing but the numbers."""

import ast
import math
from pathlib import Path

import colift.robots
import numpy as np
import pytest
from colift.base.identity.code import Code
from colift.benchmark.episode.identity import PLAYS_AND_SCORES
from colift.robots.arithmetic import dot, each, matmul

ROOT = Path(colift.robots.__file__).parents[1]

VERIFIED = (
    "benchmark/episode/replay.py",
    "benchmark/results/summary.py",
    "benchmark/statistics/averages.py",
    "benchmark/statistics/estimate.py",
    "benchmark/statistics/samples.py",
    "benchmark/statistics/student.py",
    "benchmark/statistics/superiority.py",
    "benchmark/statistics/units.py",
)
"""What computes the other numbers of a bundle."""

FOREIGN = {
    *("linalg", "dot", "vdot", "inner", "outer", "matmul", "tensordot", "einsum", "vecdot", "kron"),
    *("convolve", "correlate", "cov", "corrcoef", "polyfit", "matvec", "vecmat"),
    *("exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "power", "cbrt", "angle"),
    *("sin", "cos", "tan", "arcsin", "arccos", "arctan", "arctan2", "sinh", "cosh", "tanh"),
}
"""NumPy's names that take code from BLAS, or by the processor's vector extensions."""


def test_products_are_those_of_matrices():
    rng = np.random.default_rng(0)
    a, b, v = rng.random((4, 2, 3)), rng.random((3, 5)), rng.random(3)
    np.testing.assert_allclose(matmul(a, b), a @ b, rtol=1e-14)
    np.testing.assert_allclose(dot(a, v), a @ v, rtol=1e-14)
    np.testing.assert_allclose(matmul(a, rng.random((4, 3, 2))).shape, (4, 2, 2))
    assert dot(v, v).shape == ()


def test_a_function_is_that_of_each_number():
    values = np.linspace(-1.0, 1.0, 100).reshape(4, 25)
    assert each(math.acos, values).tolist() == [[math.acos(x) for x in row] for row in values]
    assert each(math.sin, 0.3).shape == ()


def sources():
    modules = {each.module for each in Code().definitions(*PLAYS_AND_SCORES)}
    simulating = {
        Path(*name.split(".")[1:]).with_suffix(".py") for name in modules if name != "colift"
    }
    return sorted(simulating | {Path(name) for name in VERIFIED})


@pytest.mark.parametrize("path", sources(), ids=str)
def test_neither_simulation_nor_scores_use_code_that_depends_on_the_processor(path):
    """What verifies a bundle must have its bits wherever it runs; policies may use anything."""
    used = set()
    tree = ast.parse((ROOT / path).read_text())
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    # A function of a number has an argument; a method such as that of a policy's output has none.
    methods = {id(call.func) for call in calls if not (call.args or call.keywords)}
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, ast.MatMult):
            used.add(f"@ in line {node.lineno}")
        if isinstance(node, ast.Attribute) and node.attr in FOREIGN and id(node) not in methods:
            own = isinstance(node.value, ast.Name) and node.value.id in ("math", "cmath")
            used |= set() if own else {f"{node.attr} in line {node.lineno}"}
    assert not used
