import math

import numpy as np
import pytest
from colift.agents.control.adaptive_impedance import (
    STIFFEST,
    Gains,
    LearnedImpedance,
    Movement,
    Surprise,
    adapt,
    certainty,
    compliance,
)
from colift.base.errors import InputError

TOLERANCE = 0.01


def impedance(stiffness=(1.0,), lead=0.0, offset=0.0):
    return LearnedImpedance(stiffness=np.array(stiffness), lead=lead, offset=offset)


def practise(truth, noise, gains, *, lead=0.0, sag=0.0, steps=20_000, seed=4):
    """Practise with deviations that are right up to a share, and an arm that lags and sags.

    Returns
    -------
    The mean impedance of the second half.
    """
    rng = np.random.default_rng(seed)
    now, found = impedance(), []
    for _ in range(steps):
        d = rng.normal(0.0, 0.004)
        velocity = rng.normal(0.02, 0.1)
        share = compliance(float(now.stiffness[0]))
        error = truth * d - share * d + rng.normal(0.0, noise)
        error += (lead - now.lead) * velocity + sag - now.offset
        now = adapt(now, Movement(0.0, d, share, velocity, np.ones(1)), error, TOLERANCE, gains)
        found.append((now.stiffness[0], now.lead, now.offset))
    return np.mean(found[steps // 2 :], axis=0)


def test_half_certain_at_the_tolerance():
    assert certainty(0.01**2, 0.01) == pytest.approx(0.5)
    assert certainty(0.0, 0.01) == 1.0
    assert certainty(1e6, 0.01) < 1e-9
    falling = [certainty(s**2, 0.01) for s in np.linspace(0.0, 0.1, 30)]
    assert falling == sorted(falling, reverse=True)


def test_yields_where_the_two_springs_balance():
    """K (x - plan) = 1 (partner - x): the stiffness of the table is the unit."""
    for stiffness in (0.0, 0.5, 1.0, 7.0):
        x = compliance(stiffness) * 0.03
        assert stiffness * x == pytest.approx(0.03 - x)
    assert compliance(0.0) == 1.0
    assert compliance(STIFFEST) < 0.05


@pytest.mark.parametrize("nu", [0.2, 1.0, 9.0])
def test_surprise_tends_to_a_constant_error_at_its_time_constant(nu):
    surprise = Surprise(memory=0.5, limit=25.0)
    values = [surprise.update(math.sqrt(nu) * 0.002, 0.002**2, 0.1) for _ in range(60)]
    assert values[4] == pytest.approx(nu + (1 - nu) * math.exp(-1))
    assert values[-1] == pytest.approx(nu, abs=1e-4)


def test_surprise_is_about_one_for_a_model_that_holds():
    rng = np.random.default_rng(2)
    surprise = Surprise(memory=0.5, limit=25.0)
    values = [surprise.update(e, 0.003**2, 0.1) for e in rng.normal(0.0, 0.003, 20_000)]
    assert np.mean(values) == pytest.approx(1.0, abs=0.03)


def test_surprise_does_not_depend_on_how_often_it_is_told():
    seldom, often = Surprise(memory=0.5, limit=25.0), Surprise(memory=0.5, limit=25.0)
    seldom.update(0.006, 0.002**2, 0.1)
    for _ in range(10):
        often.update(0.006, 0.002**2, 0.01)
    assert often.value == pytest.approx(seldom.value)


def test_one_outlier_counts_no_more_than_the_limit():
    surprise = Surprise(memory=0.5, limit=25.0)
    surprise.update(1e3, 1e-8, 0.1)
    assert surprise.value == pytest.approx(1 + 24 * (1 - math.exp(-0.2)))


@pytest.mark.slow
@pytest.mark.parametrize("effort", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("truth", [0.9, 0.4])
def test_practice_rests_at_the_least_squares_share_less_the_effort(truth, effort):
    gains = Gains(effort=effort)
    stiffness, _, _ = practise(truth, 0.002, gains)
    assert compliance(stiffness) == pytest.approx(truth / (1 + effort), rel=0.06)


def test_stiffness_stops_at_its_limits():
    """Deviations that were wrong altogether, and ones that were too small."""
    gains = Gains(stiffness=5.0)
    assert practise(-1.0, 0.0, gains)[0] == pytest.approx(STIFFEST, abs=0.1)
    assert practise(3.0, 0.0, gains)[0] == pytest.approx(0.0, abs=1e-3)


def test_practice_finds_the_arms_lag_and_sag():
    _, lead, offset = practise(0.8, 0.002, Gains(), lead=0.03, sag=0.002)
    assert lead == pytest.approx(0.03, abs=0.002)
    assert offset == pytest.approx(0.002, abs=0.0003)


def test_only_the_situations_that_count_adapt_their_stiffness():
    before = impedance((1.0, 1.0, 1.0))
    movement = Movement(0.0, 0.004, 0.5, 0.0, np.array([0.8, 0.2, 0.0]))
    after = adapt(before, movement, 0.003, TOLERANCE, Gains())
    change = after.stiffness - before.stiffness
    assert change[2] == 0.0
    assert change[0] == pytest.approx(4 * change[1])
    assert change[0] < 0.0, "taken up too little: more compliant"
    assert before.stiffness.tolist() == [1.0, 1.0, 1.0]


def test_a_level_table_and_no_deviation_teach_nothing():
    before = impedance((0.7, 2.0), lead=0.02, offset=0.001)
    after = adapt(before, Movement(0.01, 0.0, 0.5, 0.1, np.ones(2)), 0.0, TOLERANCE, Gains())
    assert after.stiffness.tolist() == [0.7, 2.0]
    assert (after.lead, after.offset) == (0.02, 0.001)


@pytest.mark.parametrize(
    ("parts", "told"),
    [
        ({"stiffness": (-0.1,)}, r"stiffness must be in \[0, 20\]"),
        ({"stiffness": (1.0, 20.5)}, r"got \[1.0, 20.5\]"),
        ({"stiffness": (math.nan,)}, "stiffness must be"),
        ({"lead": math.inf}, "lead must be finite, got inf"),
        ({"offset": math.nan}, "offset must be finite"),
    ],
)
def test_an_impossible_impedance_is_refused(parts, told):
    with pytest.raises(InputError, match=told):
        impedance(**parts)
