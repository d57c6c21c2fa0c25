"""The price of channels as a figure."""

from pathlib import Path

import pytest
from colift.benchmark.comparison.channels_figure import channels_figure
from colift.benchmark.comparison.over_channels import OverChannel
from colift.benchmark.rendering.figures import drawn_for, write_all
from colift.benchmark.rendering.layout import LAYOUTS, PAGE, Layout
from colift.benchmark.statistics import Estimate

from tests.printed import check_figure

CHANNELS = (None, "lan", "own.toml")


def found(policies: int) -> list[OverChannel]:
    return [
        OverChannel(
            policy=f"policy_{i}",
            channel=channel,
            rmse_mm=Estimate(mean=5.0 + i + 10 * j, ci95=(4.0 + i + 10 * j, 7.0 + i + 10 * j)),
            price_mm=Estimate(mean=10.0 * j, ci95=None),
            failed=0,
        )
        for i in range(policies)
        for j, channel in enumerate(CHANNELS)
    ]


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_it_names_policies_and_channels_in_print(layout: Layout, tmp_path: Path) -> None:
    with drawn_for(layout):
        figure = channels_figure(found(3), layout)
    write_all(tmp_path, "channels", figure, "t")
    words = check_figure(tmp_path / "channels", layout)
    assert {"policy_0", "policy_2", "no", "channel", "lan", "own.toml"} <= words


def test_a_line_has_the_error_over_each_channel() -> None:
    (axes,) = channels_figure(found(3), PAGE).axes
    for i, line in enumerate(axes.get_lines()):
        assert list(line.get_ydata()) == [5.0 + i, 15.0 + i, 25.0 + i]


def test_no_two_policies_look_alike() -> None:
    (axes,) = channels_figure(found(20), PAGE).axes
    looks = {
        (each.get_color(), each.get_linestyle(), each.get_marker()) for each in axes.get_lines()
    }
    assert len(looks) == 20
