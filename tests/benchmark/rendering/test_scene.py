import gc
import tracemalloc
from collections.abc import Iterator

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.base.registry import ROBOTS, own_entries
from colift.benchmark.environment.parallel import ParallelLift, parallel_env
from colift.benchmark.episode.recorder import Recorder
from colift.benchmark.rendering.bodies import shown_body
from colift.benchmark.rendering.modes import check_render_mode
from colift.benchmark.rendering.scene import Picture, Scene
from colift.benchmark.rendering.style import HUMAN, ROBOT, SKY
from colift.benchmark.robots.robot import make_robot
from PIL import ImageColor

PLACES = ((0.0, 0.0), (0.29, 0.29), (-0.03, 0.10))


@pytest.fixture(scope="module", params=["nao", "human"])
def kept(request: pytest.FixtureRequest) -> Iterator[Scene]:
    """A scene for many tests: PyBullet gives the memory of a closed one not back."""
    made = Scene(request.param)
    yield made
    made.close()


@pytest.fixture
def scene(kept: Scene) -> Scene:
    kept.pose(0.0, 0.0)
    return kept


def amount(picture: Picture, colour: str) -> int:
    """Return how many pixels have roughly the hue of a colour."""
    reference = np.array(ImageColor.getrgb(colour), dtype=float)
    pixels = picture.reshape(-1, 3).astype(float) + 1e-9
    cosine = pixels @ reference / np.linalg.norm(pixels, axis=1) / np.linalg.norm(reference)
    return int((cosine > 0.99).sum())


def test_picture_has_the_size_asked_for(scene: Scene) -> None:
    picture = scene.picture(96, 60)
    assert picture.shape == (60, 96, 3)
    assert picture.dtype == np.uint8


def test_same_pose_gives_the_same_picture(scene: Scene) -> None:
    scene.pose(0.1, 0.08)
    before = scene.picture(96, 60)
    scene.pose(0.2, 0.2)
    scene.pose(0.1, 0.08)
    assert np.array_equal(before, scene.picture(96, 60))


@pytest.mark.parametrize("heights", [(0.05, 0.0), (0.0, 0.05)])
def test_either_end_is_seen_to_move(scene: Scene, heights: tuple[float, float]) -> None:
    before = scene.picture(160, 100)
    scene.pose(*heights)
    assert (before != scene.picture(160, 100)).any(axis=-1).sum() > 20


@pytest.mark.parametrize("size", [(160, 90), (100, 100), (80, 120)])
def test_everybody_is_seen_whole(scene: Scene, size: tuple[int, int]) -> None:
    for place in PLACES:
        scene.pose(*place)
        picture = scene.picture(*size)
        edges = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
        # Only the sky and the pale floor reach the edges.
        assert edges.min() > 190
        assert np.array_equal(picture[0], np.broadcast_to(ImageColor.getrgb(SKY), (size[0], 3)))


def test_a_ball_is_seen_where_it_lies() -> None:
    scene = Scene("nao", ball=True)
    scene.table.roll(0.0, 0.3)
    middle = scene.picture(320, 200)
    scene.table.roll(0.2, 0.3)
    towards_robot = scene.picture(320, 200)
    scene.close()
    changed = np.argwhere((middle != towards_robot).any(axis=-1))
    assert len(changed) > 20
    # The robot is on the left.
    left, right = (
        changed[(towards_robot if here else middle)[tuple(changed.T)].max(axis=-1) < 90][
            :, 1
        ].mean()
        for here in (True, False)
    )
    assert left < right


def test_who_holds_an_end_wears_its_colour() -> None:
    robot, person = Scene("nao"), Scene("human")
    with_robot, with_person = robot.picture(160, 100), person.picture(160, 100)
    robot.close()
    person.close()
    assert amount(with_robot, HUMAN) > 100
    assert amount(with_person, ROBOT) > amount(with_robot, ROBOT) + 100


def test_a_robot_without_a_picture_is_replaced_by_words() -> None:
    assert shown_body("nao") == make_robot("nao")
    assert [shown_body(name) for name in ("human", "live", "nonesuch")] == [
        "person",
        "person",
        None,
    ]
    pictures = {}
    for name in ("nao", "winch", "derrick"):
        scene = Scene(name)
        scene.pose(0.1, 0.0)
        pictures[name] = scene.picture(320, 200)
        scene.close()
    robot = (slice(60, 140), slice(0, 120))
    assert not np.array_equal(pictures["nao"][robot], pictures["winch"][robot])
    # The names differ, and so do the words; all else is the same.
    words = (pictures["winch"] != pictures["derrick"]).any(axis=-1)
    assert 0 < words.sum() < 1000


@pytest.mark.parametrize("name", own_entries(ROBOTS))
def test_a_robot_s_hand_is_drawn_at_the_table_s_end(name: str) -> None:
    """At both ends of its stroke, where its own colours are, and not elsewhere."""
    pictures = []
    robot = make_robot(name)
    for height in robot.stroke:
        scene = Scene(name)
        scene.pose(height, height)
        pictures.append(scene.picture(320, 200))
        scene.close()
    moved = (pictures[0] != pictures[1]).any(axis=-1)
    assert moved[:, :160].sum() > 300


def test_a_real_person_at_the_robots_end_is_drawn_as_a_person() -> None:
    live, person = Scene("live"), Scene("human")
    assert np.array_equal(live.picture(160, 100), person.picture(160, 100))
    live.close()
    person.close()


def test_a_height_beyond_the_arms_is_drawn_at_their_end() -> None:
    scene = Scene("nao")
    scene.pose(0.0, 0.5)
    assert scene.picture(32, 20).shape == (20, 32, 3)
    scene.close()


def play(env: ParallelLift, *, rendered: bool) -> str:
    observations, _ = env.reset(seed=5)
    human = env.scripted_human()
    while env.agents:
        change = observations["robot"][:1] - observations["robot"][3:4]
        actions = {"human": human.act(observations["human"]), "robot": change}
        observations, *_ = env.step(actions)
        if rendered:
            picture = env.render()
            assert picture is not None
    digest = Recorder(env.lift).trace().digest()
    env.close()
    return digest


@pytest.mark.slow
def test_looking_does_not_change_the_lift() -> None:
    unseen = play(parallel_env(control_period=0.5), rendered=False)
    seen = play(parallel_env(control_period=0.5, render_mode="rgb_array"), rendered=True)
    assert seen == unseen


def test_unknown_render_mode_is_refused() -> None:
    with pytest.raises(InputError, match="'ascii'"):
        check_render_mode("ascii")


def test_without_a_display_all_is_drawn_headless(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    scene = Scene("nao", window=True)
    assert scene.picture(32, 20).shape == (20, 32, 3)
    scene.close()
    assert "DISPLAY" in caplog.text


def test_further_scenes_take_no_more_memory() -> None:
    Scene("nao").close()
    tracemalloc.start()
    try:
        for _ in range(2):
            Scene("nao").close()
        gc.collect()
        kept, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert kept < 1 << 20
