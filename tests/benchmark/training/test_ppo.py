"""Proximal policy optimisation, alone and with learned people.

It has a process of its own: JAX has threads, and forks do not mix.
"""

from pathlib import Path

import pytest
from colift.base.errors import InputError
from colift.benchmark.training.ppo_settings import CoPlaySettings, SelfPlaySettings

pytestmark = pytest.mark.slow


def test_training(in_own_process):
    modules = ("jax_ppo.py", "jax_self_play.py", "jax_co_play.py")
    in_own_process(*map(Path(__file__).with_name, modules))


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: SelfPlaySettings(haste=0.0), "haste must be above 0, got 0.0"),
        (lambda: SelfPlaySettings(haste=float("nan")), "haste must be above 0, got nan"),
        (lambda: CoPlaySettings(population=0), "population must be 1 to 100, got 0"),
        (lambda: CoPlaySettings(updates=1), "updates must be at least 2, got 1"),
        (
            lambda: CoPlaySettings(population=4, lifts=11),
            "lifts must be at least one per person of the population, 12, got 11",
        ),
    ],
)
def test_a_setting_out_of_range_is_named(make, told):
    with pytest.raises(InputError, match=told):
        make()
