"""A lift as a figure for print."""

from pathlib import Path

import pytest
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.playing import play
from colift.benchmark.rendering.figures import write_all
from colift.benchmark.rendering.layout import COLUMN, LAYOUTS, PAGE, Layout
from colift.benchmark.rendering.lift_figure import lift_figure, lift_title
from colift.benchmark.suites.catalogue import make_scenario, make_task

from tests.printed import check_figure

TASKS = {"level": "blend", "intent": "pose_wrist", "agree": "agree_leader", "ball": "ball_calm"}


def played(task: str) -> tuple[Episode, Scenario, AgentSpec]:
    spec = checked_policy(TASKS[task])
    scenario = make_scenario(make_task(task).behaviours[0], "S1", "nao", 0.1, 0.1, task)
    (episode,) = play(spec, scenario, (0,))
    return episode, scenario, spec


@pytest.fixture(scope="module")
def lift() -> tuple[Episode, Scenario, AgentSpec]:
    return played("level")


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_its_words_are_text_and_its_moments_pictures(
    lift: tuple[Episode, Scenario, AgentSpec], layout: Layout, tmp_path: Path
) -> None:
    episode, scenario, spec = lift
    figure = lift_figure(episode, scenario, layout)
    write_all(tmp_path, "lift", figure, lift_title(episode, spec.name))
    words = check_figure(tmp_path / "lift", layout, pictures=3)
    assert {"human's", "robot's", "intention", "height", "time", "0.0", "difference"} <= words


def test_the_same_lift_gives_the_same_files(
    lift: tuple[Episode, Scenario, AgentSpec], tmp_path: Path
) -> None:
    episode, scenario, _ = lift
    for name in ("one", "other"):
        write_all(tmp_path, name, lift_figure(episode, scenario, COLUMN), "t")
    for suffix in (".png", ".svg", ".pdf"):
        one, other = ((tmp_path / f"{name}{suffix}").read_bytes() for name in ("one", "other"))
        assert one == other


@pytest.mark.parametrize(
    "layout",
    [pytest.param(COLUMN, id="column"), pytest.param(PAGE, id="page", marks=pytest.mark.slow)],
)
@pytest.mark.parametrize("task", [*TASKS][1:])
def test_every_task_is_for_print_and_nothing_is_cut_off(
    task: str, layout: Layout, tmp_path: Path
) -> None:
    episode, scenario, _ = played(task)
    figure = lift_figure(episode, scenario, layout)
    write_all(tmp_path, task, figure, "t")
    check_figure(tmp_path / task, layout, pictures=3)
    used = figure.get_tightbbox()
    assert used.x0 >= 0.0
    assert used.x1 <= layout.width + 0.01
