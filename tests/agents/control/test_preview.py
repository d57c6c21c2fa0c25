import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.control.preview import preview_gains


def best_first(path, command, last, frames, steps, smoothness):
    """Return the first command of the least cost, by brute least squares on all commands."""
    times = np.arange(1, frames * steps + 1) / frames
    ends = np.eye(steps + 1)
    ramps = np.array([np.interp(times, np.arange(steps + 1), end) for end in ends]).T
    # Rows of the square root of the cost, in u_1 ... u_n.
    rows = [np.sqrt(FRAME) * ramps[:, 1:]]
    values = [np.sqrt(FRAME) * (path - ramps[:, 0] * command)]
    weight = np.sqrt(frames * FRAME * smoothness)
    for i in range(steps):
        bend = np.zeros(steps + 2)
        bend[i : i + 3] = weight * np.array([1.0, -2.0, 1.0])
        rows.append(bend[np.newaxis, 2:])
        values.append(np.array([-bend[0] * last - bend[1] * command]))
    found, *_ = np.linalg.lstsq(np.vstack(rows), np.concatenate(values), rcond=None)
    return found[0]


@pytest.mark.parametrize(("frames", "steps"), [(10, 4), (10, 1), (2, 20), (5, 8)])
@pytest.mark.parametrize("smoothness", [0.0, 0.03, 1.0])
def test_the_law_is_that_of_the_least_cost(frames, steps, smoothness):
    rng = np.random.default_rng(0)
    path = 0.1 * rng.normal(size=frames * steps)
    law = preview_gains(frames, steps, smoothness)
    wanted = best_first(path, 0.05, 0.03, frames, steps, smoothness)
    assert law(path, 0.05, 0.03) == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize("smoothness", [0.0, 0.03, 10.0])
def test_a_straight_line_is_followed_at_any_cost(smoothness):
    path = 0.02 + 0.1 * FRAME * np.arange(1, 41)
    law = preview_gains(10, 4, smoothness)
    assert law(path, 0.02, 0.01) == pytest.approx(0.03)


def test_a_dearer_bend_is_a_smaller_one():
    path = np.full(40, 0.1)
    bends = [preview_gains(10, 4, smoothness)(path, 0.0, 0.0) for smoothness in (0.0, 0.1, 1.0)]
    assert bends[0] > bends[1] > bends[2] > 0.0


def test_a_stop_in_mid_period_is_shared_between_the_ramps():
    """The best broken line overshoots where the path bends, instead of meeting it at the ends."""
    path = np.minimum(FRAME * np.arange(1, 41), 0.05)
    first = preview_gains(10, 4, 0.0)(path, 0.0, 0.0)
    assert 0.05 < first < 0.07
