"""The parts of the page that need no room: messages, clock, frames, hand, steering, delays."""

import itertools
import math

import pytest
from colift.play.rooms.live_lift import Shown
from colift.play.rooms.messages import LATE, STARVED, dump_frame, parse_samples


@pytest.fixture(scope="module")
def run(chromium, url):
    """Return what runs a script in a page, with ``play`` for its parts."""
    page = chromium.new_page()
    page.goto(url)
    yield lambda script, argument=None: page.evaluate(
        f"""(argument) => {{
            const play = coliftPlay;
            try {{ {script} }} finally {{ delete performance.now; }}
        }}""",
        argument,
    )
    page.close()


def test_samples_arrive_as_they_were(run):
    samples = [[1e6 + 0.125 * i, math.sin(i)] for i in range(200)]
    sent = run("return [...new Uint8Array(play.packSamples(7, argument))];", samples)
    content = parse_samples(bytes(sent))
    assert content.first == 7
    assert [time for time, _ in content.samples] == [time / 1000 for time, _ in samples]
    heights = [height for _, height in content.samples]
    assert heights == pytest.approx([height for _, height in samples], abs=1e-7)


def test_frames_arrive_as_they_were(run):
    sent = dump_frame(Shown(431, 0.125, -0.25, 3.5), flags=LATE | STARVED, used=99)
    assert run("return play.unpackFrame(new Uint8Array(argument).buffer);", list(sent)) == {
        "late": True,
        "starved": True,
        "frame": 431,
        "human": 0.125,
        "robot": -0.25,
        "force": 3.5,
        "used": 99,
    }
    assert run("return play.unpackFrame(new Uint8Array(argument).buffer);", [2] * 24) is None
    assert run("return play.unpackFrame(new Uint8Array(argument).buffer);", [1] * 23) is None


def test_the_clock_believes_the_quickest_answer_until_it_is_old(run):
    offsets = run("""
        const clock = new play.Clock(), found = [];
        clock.add(0, 5040, 40);  // 5000 plus or minus 20
        found.push(clock.offset);
        clock.add(100, 5102, 102);
        found.push(clock.offset);
        clock.add(200, 5290, 280);
        found.push(clock.offset);
        clock.add(400000, 405024, 400030);
        found.push(clock.offset);
        return found;
    """)
    assert offsets == [5020, 5001, 5001, 5009]


FRAMES = """
    const frames = new play.Frames();
    frames.begin(1000, 300, 20);
    const add = (n, arrived, late = false) =>
        frames.add({ frame: n, human: n / 1000, robot: n / 500, used: 2 * n, late }, arrived);
"""


def test_a_picture_is_of_one_moment_between_two_frames(run):
    look = f"{FRAMES} for (let n = 1; n <= 9; n++) add(n, 1000 + 10 * n + 3);"
    at = run(f"{look} return frames.look(1020 + 45);")
    assert at["human"] == pytest.approx(0.0045)
    assert at["robot"] == pytest.approx(0.009)
    assert (at["frame"], at["used"], at["starved"]) == (4, 8, False)
    held = run(f"{look} return frames.look(1020 + 120);")
    assert held["human"] == pytest.approx(0.009)
    assert held["robot"] == pytest.approx(0.018)
    assert (held["starved"], held["lateMs"]) == (True, 30)
    before = run(f"{look} return frames.look(900);")
    assert (before["human"], before["starved"]) == (0, False)


def test_the_next_playout_covers_nearly_all_lateness(run):
    def wish(late):
        script = "for (let n = 1; n <= 300; n++) add(n, 1000 + 10 * n + argument(n));"
        script = script.replace("argument(n)", late)
        return run(f"{FRAMES} {script} frames.learn(); return frames.wish;")

    assert wish("(n % 50 ? 8 : 22)") == 24
    assert wish("0.5") == 5
    assert wish("900") == 150
    assert wish("(n % 9 ? 6 : 80), n % 9 == 0") == 8
    assert run(f"{FRAMES} frames.learn(); return frames.wish;") == 12


HAND = """
    const sent = [], later = [];
    let now = 0;
    performance.now = () => now;
    const hand = new play.Hand((first, samples) => sent.push([now, first, samples]),
        (what, ms) => later.push([now + ms, what]));
    const pass = (until, each) => {
        for (; now < until; now += 1) {
            each(now);
            while (later.length && later[0][0] <= now) later.shift()[1]();
        }
    };
"""


def test_a_fast_mouse_sends_every_sample_in_few_messages(run):
    sent = run(f"""{HAND}
        hand.close("mouse");
        hand.place(0, 0.05, 0);
        hand.start(0);
        pass(1000, (ms) => hand.place(ms + 0.5, 0.05 + ms / 10000, ms));
        hand.flush(now);
        return sent;
    """)
    samples = [each for _, _, part in sent for each in part]
    assert len(samples) == 1001
    assert len(sent) <= 340  # Fewer than the server takes in a second.
    assert [first for _, first, _ in sent] == [
        sum(len(part) for _, _, part in sent[:i]) for i in range(len(sent))
    ]
    times = [time for time, _ in samples]
    assert all(a < b for a, b in itertools.pairwise(times))
    assert samples[0][1] == 0  # The height at the start is the new zero.
    assert samples[-1][1] == pytest.approx(0.0999)
    assert max(part[-1][0] - part[0][0] for _, _, part in sent) < 10


def test_a_hand_that_rests_is_seen_to_rest(run):
    sent = run(f"""{HAND}
        hand.close("mouse");
        hand.start(0);
        hand.place(1, 0.02, 1);
        pass(500, (ms) => ms % 10 || hand.still(ms, 4));
        return sent;
    """)
    samples = [each for _, _, part in sent for each in part]
    gaps = [b[0] - a[0] for a, b in itertools.pairwise(samples[1:])]
    assert gaps[0] < 60  # That no event comes is only news after a while.
    assert 10 <= min(gaps) <= max(gaps[1:]) <= 20
    assert {height for _, height in samples[1:]} == {0.02}


def test_a_hand_stays_within_reach(run):
    height = f"""{HAND} hand.close("mouse"); hand.start(0);
        hand.place(1, argument, 1); return hand.height;"""
    assert run(height, 3) == 0.38
    assert run(height, -3) == -0.08


def test_keys_give_a_smooth_velocity_at_a_fixed_rate(run):
    samples = run("""
        const steering = new play.Steering(0), found = [];
        for (const [until, wanted] of [[400, 1], [800, 0], [1200, -1]]) {
            for (let now = steering.time; now <= until; now += 3.7) {
                steering.wanted = wanted;
                found.push(...steering.until(now));
            }
        }
        return found;
    """)
    times = [time for time, _ in samples]
    assert times == [10.0 * (i + 1) for i in range(len(times))]
    speeds = [100 * (b[1] - a[1]) for a, b in itertools.pairwise(samples)]
    assert max(speeds) == pytest.approx(0.15)
    assert min(speeds) == pytest.approx(-0.15)
    rates = [100 * (b - a) for a, b in itertools.pairwise(speeds)]
    assert max(map(abs, rates)) <= 1.5 + 1e-6


def test_a_delay_is_counted_once_for_each_sample_that_is_new(run):
    found = run("""
        const delays = new play.Delays(), times = [0, 10, 20, 30];
        const see = (used, now) => delays.drawn({ used, lateMs: 0, starved: false }, times, now);
        see(0, 20); see(1, 36); see(1, 52); see(3, 68); see(9, 84);
        return [delays.delays, delays.median, delays.p95, delays.refresh];
    """)
    assert found == [[36, 48], 36, 48, 63]


def test_no_report_is_longer_than_a_message_may_be(run):
    lengths = run("""
        const delays = new play.Delays(), times = [];
        for (let n = 1; n <= 2000; n++) {
            times.push(8 * n - 140.123);
            delays.drawn({ used: n, lateMs: 100.777, starved: true }, times, 8 * n);
        }
        const parts = delays.reports(12);
        const all = parts.flatMap((part) => part.delays_ms).length;
        return [all, ...parts.map((part) => JSON.stringify(part).length)];
    """)
    assert lengths[0] == 2000
    assert max(lengths[1:]) < 4096


@pytest.mark.parametrize(
    ("fragment", "seat"), [("#s=20260101-ab.Se_-1", 0), ("#p=a.b", 1), ("#w=a.b", "spectator")]
)
def test_a_link_says_the_place(run, fragment, seat):
    place = run("return play.placeOf(argument);", fragment)
    assert place["seat"] == seat
    assert fragment[3:] == f"{place['session']}.{place['secret']}"


@pytest.mark.parametrize("fragment", ["", "#", "#x=a.b", "#s=a", "#s=<a>.b"])
def test_what_is_no_link_is_none(run, fragment):
    assert run("return play.placeOf(argument);", fragment) is None


@pytest.mark.parametrize(
    ("goal", "hand", "words"),
    [
        (0.2, 0.0, "Lift to the line."),
        (0.1, 0.15, "Lower to the line."),
        (0.2, 0.15, "Lift to the line."),
        (0.0, 0.2, "Back to rest."),
        (0.0, -0.02, "Back to rest."),
    ],
)
def test_a_goal_is_above_or_below_the_hand(run, goal, hand, words):
    assert run("return play.goalWords(...argument);", [goal, hand]) == words


MANAGED = "blend would have managed 3.1 mm with"


@pytest.mark.parametrize(
    ("best", "partner", "leads", "words"),
    [
        ("blend", "copy", True, f"{MANAGED} your movement (you and copy: 4.5 mm)."),
        ("copy", "copy", True, "Of all policies, copy is the best with your movement."),
        (
            "blend",
            "person",
            False,
            f"{MANAGED} the leader's movement (you and another person: 4.5 mm).",
        ),
    ],
)
def test_a_standing_says_with_whose_movement(run, best, partner, leads, words):
    found = run(
        "return play.standingWords({ policies: [argument.shift()] }, ...argument);",
        [{"name": best, "rmse_mm": 3.1}, partner, 4.5, leads],
    )
    assert found == words
