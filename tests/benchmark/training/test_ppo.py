"""Proximal policy optimisation, in a process of its own: JAX has threads, and forks do not mix."""

from pathlib import Path


def test_proximal_policy_optimisation(in_own_process):
    in_own_process(Path(__file__).with_name("jax_ppo.py"))
