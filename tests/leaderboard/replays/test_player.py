"""The player in a real browser, from a file."""

import json
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario
from colift.leaderboard.replays.chosen import chosen_replays
from colift.leaderboard.replays.html import replay_page, script_json
from colift.leaderboard.replays.replay import play_ghost, replay_content
from playwright.sync_api import expect

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(bundle, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("pages") / "replay.html"
    path.write_text(replay_page(chosen_replays(bundle, "blend")), encoding="utf-8")
    return path


@pytest.fixture
def open_page(chromium, file):
    """Return what opens the file; at the end, nothing was asked for and nothing went wrong."""
    contexts, troubles = [], []

    def opened(place="", motion="reduce", **options):
        context = chromium.new_context(reduced_motion=motion, **options)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: troubles.append(str(error)))
        page.on("console", lambda told: troubles.append(told.text))
        page.on("request", lambda asked: asked.url == file.as_uri() or troubles.append(asked.url))
        page.goto(file.as_uri() + place)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert not troubles


def slider(page):
    return page.get_by_role("slider", name="Time in the lift")


def wait_until_past(page, time):
    # The page's policy forbids what Playwright's own wait_for_function does.
    for _ in range(200):
        if float(slider(page).input_value()) > time:
            return
        page.wait_for_timeout(50)
    raise AssertionError("it does not play")


def difference(page):
    text = page.locator(".row-error dd").inner_text()
    return float(text.replace("\N{MINUS SIGN}", "-").removesuffix(" mm"))


def bubble(page):
    return float(page.locator(".bubble.real").get_attribute("cx"))


def episode_of(page, bundle):
    """Return the episode of a page that shows a pause."""
    person = re.search(r"draw-\d+", page.locator(".replay-about").inner_text())[0]
    (episode,) = [e for e in bundle.episodes if (e.behaviour, e.subject) == ("pause", person)]
    return episode


def test_scrubbing_shows_the_lift_at_that_time(open_page, bundle):
    page = open_page("#pause-median")
    episode = episode_of(page, bundle)
    rest = bubble(page)
    for time in (1.4, 2.0, 4.2):
        slider(page).fill(str(time))
        frame = round(100 * time) - 1
        human, robot = episode.trace.human_end[frame], episode.trace.robot_end[frame]
        assert difference(page) == pytest.approx(1000 * (robot - human), abs=0.11)
        told = page.locator("dt", has_text="human's end").locator("xpath=../dd").inner_text()
        assert int(told.removesuffix(" mm")) == pytest.approx(1000 * human, abs=0.6)
        # The bubble goes to the higher end; the robot is on the left.
        if abs(robot - human) > 0.005:
            assert (bubble(page) < rest) == (robot > human)


def test_the_table_is_drawn_as_it_is_inclined(open_page, bundle):
    page = open_page("#pause-median")
    trace = episode_of(page, bundle).trace
    slider(page).fill(f"{0.1 * round(0.1 * (trace.human_end - trace.robot_end).argmax()):.1f}")
    table = page.locator(".replay-table.real").get_attribute("transform")
    turn = float(re.search(r"rotate\((.*)\)", table)[1])
    # The human's end, on the right, is higher: the picture turns against the clock.
    assert difference(page) < -5
    sine = difference(page) / 800
    assert turn == pytest.approx(57.3 * sine, abs=0.02)


def test_keys_play_pause_and_go_by_a_step(open_page):
    page = open_page()
    now = lambda: float(slider(page).input_value())  # noqa: E731
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    assert now() == pytest.approx(0.2)
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Shift+ArrowRight")
    assert now() == pytest.approx(1.1)
    page.keyboard.press(".")
    assert now() == pytest.approx(1.11)
    page.keyboard.press(",")
    page.keyboard.press("Space")
    wait_until_past(page, 1.3)
    page.keyboard.press("Space")
    stood = now()
    page.wait_for_timeout(120)
    assert now() == stood
    page.keyboard.press("End")
    assert now() == pytest.approx(float(slider(page).get_attribute("max")))
    page.keyboard.press("Home")
    assert now() == 0.0


def test_the_scrubber_itself_takes_the_arrows(open_page):
    page = open_page()
    slider(page).focus()
    page.keyboard.press("ArrowRight")
    assert float(slider(page).input_value()) == pytest.approx(0.1)
    assert "0.10 s" in slider(page).get_attribute("aria-valuetext")


def test_space_on_a_button_presses_it_once(open_page):
    page = open_page()
    page.get_by_role("button", name="Play").focus()
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Pause")).to_have_count(1)


def test_it_plays_at_the_chosen_speed_to_the_end(open_page):
    page = open_page()
    page.get_by_label("Speed").select_option("4")
    slider(page).fill(str(float(slider(page).get_attribute("max")) - 0.4))
    page.get_by_role("button", name="Play").click()
    page.get_by_role("button", name="Play").wait_for()
    assert slider(page).input_value() == slider(page).get_attribute("max")


def test_it_moves_by_itself_only_where_motion_is_welcome(open_page):
    still = open_page()
    moving = open_page(motion="no-preference")
    wait_until_past(moving, 0.2)
    assert float(slider(still).input_value()) == 0.0


def test_a_drag_on_the_curves_goes_there(open_page):
    page = open_page()
    chart = page.locator(".replay-chart > svg").first
    chart.scroll_into_view_if_needed()
    box = chart.bounding_box()
    y = box["y"] + 60
    page.mouse.move(box["x"] + 200, y)
    page.mouse.down()
    first = float(slider(page).input_value())
    page.mouse.move(box["x"] + 400, y)
    page.mouse.up()
    assert float(slider(page).input_value()) > first > 0.5
    page.mouse.move(box["x"] + 100, y)
    assert float(slider(page).input_value()) > first


def test_the_two_people_can_be_hidden(open_page):
    page = open_page()
    ghost = page.locator(".replay-ghost").first
    assert ghost.is_visible()
    page.get_by_label("two people").uncheck()
    assert not ghost.is_visible()
    page.keyboard.press("g")
    assert ghost.is_visible()


def test_the_address_says_which_lift_is_shown(open_page, file):
    page = open_page("#jerky-worst")
    assert "jerks" in page.locator(".replay-about").inner_text()
    assert page.get_by_role("button", name="worst").get_attribute("aria-pressed") == "true"
    page.get_by_label("How the human lifts").select_option("changing_goal")
    assert "#changing_goal-worst" in page.url
    page.get_by_role("button", name="best").click()
    assert "#changing_goal-best" in page.url


def test_a_lift_that_failed_says_so_from_then_on(open_page, file):
    page = open_page()
    text = file.read_text()
    data = re.search('id="replay-data">(.*?)</script>', text)[1]
    content = json.loads(data)
    first = content["replays"][0]
    first["failure"] = "step 20: <b>it fell</b>"
    for name in ("human", "robot", "target"):
        first[name] = first[name][:200]
    broken = file.with_name("broken.html")
    broken.write_text(text.replace(data, script_json({**content, "replays": [first]})))
    page = page.context.new_page()
    page.goto(broken.as_uri())
    assert "The lift failed: step 20: <b>it fell</b>" in page.locator(".replay-about").inner_text()
    slider(page).fill("1.9")
    assert "mm" in page.locator(".replay-level text").text_content()
    slider(page).fill("2.5")
    assert page.locator(".replay-level text").text_content() == "the lift is over"
    assert page.locator(".row-error dd").inner_text() == "counts as 250 mm"
    assert not page.locator(".bubble.real").is_visible()


def test_picture_and_curves_stand_in_one_window(open_page):
    page = open_page("#jerky-worst", viewport={"width": 1280, "height": 900})
    for part in (".replay-stage", ".replay-readout", "[type=range]", ".replay-chart >> nth=1"):
        box = page.locator(part).bounding_box()
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= 900
    stage = page.locator(".replay-stage").bounding_box()
    bar = page.locator(".replay-controls").bounding_box()
    assert bar["y"] >= stage["y"] + stage["height"]  # The feet are seen.


def test_on_a_telephone_the_numbers_are_below_the_picture(open_page):
    page = open_page("#jerky-worst", viewport={"width": 390, "height": 844})
    stage = page.locator(".replay-stage").bounding_box()
    numbers = page.locator(".row-error").first.bounding_box()
    assert stage["y"] < 250
    assert (
        numbers["y"] + numbers["height"]
        < 844 - page.locator(".replay-controls").bounding_box()["height"]
    )


@pytest.mark.parametrize("width", [360, 1280])
def test_nothing_is_wider_than_the_screen(open_page, width):
    page = open_page(viewport={"width": width, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.fixture
def page_of_lift(chromium, tmp_path):
    """Return what opens the replay of a lift 5 s after its beginning, and returns its episode."""
    pages, troubles = [], []

    def opened(policy, scenario, **options):
        episode = next(play(PolicySpec(text=policy), scenario, (0,)))
        content = replay_content(episode, scenario, play_ghost(scenario, 0), policy=policy)
        path = tmp_path / "lift.html"
        path.write_text(replay_page([content]), encoding="utf-8")
        page = chromium.new_page(reduced_motion="reduce", **options)
        pages.append(page)
        page.on("pageerror", lambda error: troubles.append(str(error)))
        page.goto(path.as_uri())
        for _ in range(50):
            page.keyboard.press("ArrowRight")
        return page, episode

    yield opened
    for page in pages:
        page.close()
    assert not troubles


def test_the_intended_pose_is_drawn_and_the_error_is_the_distance_to_it(page_of_lift):
    page, episode = page_of_lift("pose_wrist", make_scenario("counter", "S3", task="intent"))
    expect(page.locator(".replay-key", has_text="intended far end")).to_be_visible()
    expect(page.locator("line.intended-pose")).not_to_have_class("none")
    expect(page.locator(".replay-level")).to_be_hidden()
    trace = episode.trace
    missed = 1000 * (trace.robot_end[499] - trace.added["far_target"][499])
    assert difference(page) == pytest.approx(missed, abs=0.15)


@pytest.mark.parametrize("width", [390, 1280])
def test_a_ball_lies_on_the_table_and_the_error_is_its_distance_from_the_target(
    page_of_lift, width
):
    scenario = make_scenario("ball_smooth", "S3", task="ball")
    page, episode = page_of_lift("ball_game", scenario, viewport={"width": width, "height": 800})
    place, target = (episode.trace.added[name][499] for name in ("ball", "ball_target"))
    assert difference(page) == pytest.approx(1000 * (place - target), abs=0.15)
    # The middle of the table is 0.4 m from the human's end, where x is 0; the robot is on the left.
    ball = page.locator(".replay-table.real .ball")
    assert float(ball.get_attribute("cx")) == pytest.approx(-0.4 - place, abs=2e-4)
    expect(page.locator(".replay-table.ghost .ball")).to_be_visible()
    aim = page.locator(".replay-table.real .aim").get_attribute("transform")
    moved = float(re.search(r"translate\((\S+) 0\)", aim)[1])
    assert moved == pytest.approx(-0.4 - target, abs=2e-4)
    expect(page.locator(".replay-level")).to_be_hidden()
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_hurdles_are_bars_that_open_and_tell_by_how_much_they_are_missed(page_of_lift):
    page, episode = page_of_lift("agree_game", make_scenario("abreast", "S3", task="agree"))
    intention = page.locator("path.intention").first.get_attribute("transform")
    rest = float(re.search(r" (\S+)\)", intention)[1])
    for end in ("human", "robot"):
        series = episode.trace.added[f"{end}_hurdle"]
        window = np.flatnonzero(series != episode.trace.target)
        assert window[0] < 499 > window[-1]
        bar = page.locator(f".replay-scene line.hurdle.{end}")
        expect(bar).to_have_class(re.compile("closed"))
        height = series[window[0]] - episode.trace.target[499]
        assert rest - float(bar.get_attribute("y1")) == pytest.approx(height, abs=2e-4)
        missed = episode.scores[f"{end}_hurdle_mm"]
        words = f"{end}'s hurdle missed by {missed:.0f} mm"
        expect(page.locator(".replay-chart text.words", has_text=words)).to_be_visible()
        expect(page.locator(f".row-{end}", has_text=f"off {missed:.0f} mm")).to_be_visible()
    slider(page).fill(str(window[0] / 100 + 0.5))
    expect(page.locator(".replay-scene line.hurdle.robot")).to_have_class(re.compile("open"))
    expect(page.locator("figcaption", has_text="Difference")).to_be_visible()


@pytest.mark.parametrize("width", [640, 1200, 1920])
@pytest.mark.parametrize(
    ("policy", "behaviour", "task"),
    [
        ("blend", "pause", "level"),
        ("pose_bayes", "switching", "intent"),
        ("ball_game", "ball_pause", "ball"),
        ("agree_game", "abreast", "agree"),
    ],
)
def test_keys_stand_in_a_line_and_names_of_phases_keep_clear(
    page_of_lift, policy, behaviour, task, width
):
    scenario = make_scenario(behaviour, "S2", task=task)
    page, _ = page_of_lift(policy, scenario, viewport={"width": width, "height": 900})
    for caption in page.locator("figcaption").all():
        (*keys,) = (each.bounding_box() for each in caption.locator("> *").all())
        assert max(each["y"] for each in keys) < min(each["y"] + each["height"] for each in keys)
        assert all(a["x"] + a["width"] <= b["x"] for a, b in pairwise(keys))
    names = [each.bounding_box() for each in page.locator("text.event").all()]
    lines = [each.bounding_box() for each in page.locator("line.event").all()]
    box = page.locator(".replay-chart > svg").first.bounding_box()
    assert len(names) >= 3
    assert all(each["x"] + each["width"] <= box["x"] + box["width"] for each in names)
    for name in names:
        others = [*lines, *(other for other in names if other is not name)]
        assert not any(_meet(name, other) for other in others)


def _meet(one, other):
    """Return whether two boxes overlap by more than a pixel in height, and at all in width."""
    left, top = (max(one[at], other[at]) for at in "xy")
    right, bottom = (
        min(one[a] + one[b], other[a] + other[b]) for a, b in (["x", "width"], ["y", "height"])
    )
    return left <= right and bottom - top > 1


def test_the_player_draws_no_nao_for_another_holder(chromium, tmp_path):
    scenario = make_scenario("smooth", "S1")
    episode = next(play(PolicySpec(text="copy"), scenario, (0,)))
    content = replay_content(episode, scenario, play_ghost(scenario, 0), policy="copy")
    words = "no picture of the robot crane"
    for holder in (None, "person", words):
        path = tmp_path / "lift.html"
        told = {} if holder is None else {"holder": holder}
        path.write_text(replay_page([{**content, **told}]), encoding="utf-8")
        page = chromium.new_page(reduced_motion="reduce")
        page.goto(path.as_uri())
        robot, second = page.locator(".replay-nao").first, page.locator(".replay-person.partner")
        expect(robot).to_be_visible() if holder is None else expect(robot).to_be_hidden()
        expect(second.last).to_be_visible(visible=holder == "person")
        expect(page.locator(".replay-scene text", has_text="no picture")).to_have_count(
            1 if holder == words else 0
        )
        page.close()
