"""What is drawn where: every policy with its name, nothing over anything."""

import dataclasses
import itertools

import numpy as np
import pytest
from colift.benchmark.comparison.comparison import Comparison, compare
from colift.benchmark.comparison.picture import comparison_figure
from colift.benchmark.comparison.scale import Scale, make_scale, spots
from colift.benchmark.rendering.style import FAINT, ROBOT
from colift.benchmark.results.baselines import Baseline
from matplotlib.axes import Axes
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from .conftest import DIFFICULTY, contest, entry, noise


@pytest.fixture(scope="module")
def crowd() -> Comparison:
    """Fourteen policies that differ by a few millimetres, two of them not at all."""
    rng, size = np.random.default_rng(0), 14
    means = rng.uniform(1.0, 6.0, size)
    smooth = rng.normal(-2.0, 0.2, size)
    means[1], smooth[1] = means[0], smooth[0]
    return compare(
        contest(
            *(
                entry(f"policy,gain={mean:.4f}"[: 6 + 3 * i], DIFFICULTY + mean + noise(i), y)
                for i, (mean, y) in enumerate(zip(means, smooth, strict=True))
            )
        )
    )


def drawn(comparison: Comparison, **size: float) -> tuple[Axes, list[Text]]:
    figure = comparison_figure(comparison, **size)
    axes = figure.axes[0]
    return axes, [text for text in axes.texts if text.get_text()]


@pytest.mark.parametrize(("width", "height"), [(8.0, 5.6), (4.0, 5.2)])
def test_names_of_a_crowd_do_not_overlap_and_stay_inside(
    crowd: Comparison, width: float, height: float
) -> None:
    axes, texts = drawn(crowd, width=width, height=height)
    assert len(texts) == 15
    boxes = [text.get_window_extent() for text in texts]
    frame = axes.get_window_extent()
    for box in boxes:
        assert frame.x0 <= box.x0 < box.x1 <= frame.x1
        assert frame.y0 <= box.y0 < box.y1 <= frame.y1
    for one, other in itertools.combinations(boxes, 2):
        shared = Bbox.intersection(one, other)
        assert shared is None or shared.width * shared.height < 1.0


def test_every_policy_and_the_team_is_named(comparison: Comparison) -> None:
    _, texts = drawn(comparison)
    told = " ".join(text.get_text() for text in texts)
    for name in ("leader", "twin", "follower", "failing *", "still", "human-human team"):
        assert name in told


def scaled(comparison: Comparison) -> tuple[Scale, dict[str, tuple[float, float]]]:
    scale = make_scale(spots(comparison))
    return scale, {spot.name: scale.place(spot) for spot in spots(comparison)}


def test_what_is_far_off_goes_to_the_edge_and_does_not_squeeze_the_rest(
    comparison: Comparison,
) -> None:
    scale, places = scaled(comparison)
    assert scale.x[1] < 50.0
    assert scale.x[1] < places["still"][0] < scale.right
    _, texts = drawn(comparison)
    assert any(text.get_text() == "still\n120 mm" for text in texts)


def test_a_robot_without_smoothness_is_below_all_others(comparison: Comparison) -> None:
    scale, places = scaled(comparison)
    assert places["still"][1] < scale.y[0] < min(y for n, (_, y) in places.items() if n != "still")


def test_what_is_on_the_scale_is_where_its_numbers_are(comparison: Comparison) -> None:
    _, places = scaled(comparison)
    leader = next(s for s in comparison.overall.standings if s.name == "leader")
    assert leader.sparc is not None
    assert places["leader"] == (leader.rmse_mm.mean, leader.sparc.mean)


def test_policies_alike_are_all_drawn_to_scale_however_bad() -> None:
    bad = compare(contest(entry("a", 120.0 + noise(0), np.nan), entry("b", 118.0 + noise(1), -3.0)))
    scale, places = scaled(bad)
    assert not scale.beyond
    assert places["a"][0] == pytest.approx(120.0)


def test_bounds_do_not_push_policies_off_the_scale() -> None:
    policies = contest(*(entry(f"{mm}", mm + noise(mm), -2.0) for mm in (12, 14, 34)))
    near = Baseline(
        strata=policies.team.strata,
        rmse_mm=(0.1,) * len(policies.team.strata),
        means={"sparc": -1.9, "human_force_n": 0.1},
    )
    bounded = dataclasses.replace(policies, bounds={"oracle": near, "causal_bound": near})
    scale, places = scaled(compare(bounded))
    assert not scale.beyond
    assert places["oracle"] == pytest.approx((0.1, -1.9))


def test_the_front_is_filled_and_the_rest_is_not(comparison: Comparison) -> None:
    colours = {spot.name: (spot.colour, spot.filled) for spot in spots(comparison)}
    assert colours["follower"] == (ROBOT, True)
    assert colours["twin"] == (FAINT, False)


def test_the_line_of_the_team_is_at_one(comparison: Comparison) -> None:
    figure = comparison_figure(comparison)
    (above,) = figure.axes[0].child_axes
    ticks = {
        label.get_text(): tick
        for tick, label in zip(above.get_xticks(), above.get_xticklabels(), strict=True)
    }
    assert ticks["1\N{MULTIPLICATION SIGN}"] == 1.0
    line = [li for li in figure.axes[0].lines if list(li.get_xdata()) == [9.5, 9.5]]
    assert line


def test_two_policies_that_hold_still_can_be_drawn() -> None:
    still = compare(contest(entry("a", 120.0, np.nan), entry("b", 120.0, np.nan)))
    _, texts = drawn(still)
    assert {"a", "b"} <= {text.get_text().partition("\n")[0] for text in texts}
