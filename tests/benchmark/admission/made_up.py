"""Made-up evidence: errors of policies with people, of which the truth is known."""

import numpy as np
from colift.benchmark.admission.evidence import Evidence
from colift.benchmark.admission.played import Played


def errors(seed, shape, *, policy=0.0, suits=0.0, noise=0.3, person=0.3):
    """Return log-normal errors (policies, people, lifts) [mm] with these standard deviations."""
    rng = np.random.default_rng(seed)
    p, h, k = shape
    logs = policy * rng.standard_normal((p, 1, 1)) + suits * rng.standard_normal((p, h, 1))
    logs = logs + person * rng.standard_normal((1, h, 1)) + 0.3 * rng.standard_normal((1, h, k))
    return np.exp(3.0 + logs + noise * rng.standard_normal(shape))


def played(values, names=None):
    """Return errors with names."""
    names = names or tuple(f"policy{i}" for i in range(len(values)))
    people = tuple(f"draw-{i}" for i in range(values.shape[1]))
    return Played(players=names, people=people, errors=values)


def evidence(values=None, *, alone=(), two_people=10.0, idle=100.0, **more):
    """Return the evidence of policies, with a constant error of hold and of two people [mm]."""
    values = errors(0, (3, 4, 2)) if values is None else values
    names = tuple(f"policy{i}" for i in range(len(values)))
    rest = np.ones((2, *values.shape[1:])) * np.array([idle, two_people])[:, None, None]
    rest = rest * np.exp(0.05 * np.random.default_rng(0).standard_normal(rest.shape))
    return Evidence(
        played=played(np.concatenate((values, rest)), (*names, "hold", "two")),
        policies=names,
        references=(),
        settings=(),
        alone=frozenset(alone),
        idle="hold",
        two_people="two",
        **more,
    )
