"""Figures of live lifts that only a quiet machine gives: people in a browser, rooms, and delays.

python -m tests.play.web.measure alone 10    # against the same people offline
python -m tests.play.web.measure pair 10
python -m tests.play.web.measure least 3     # event to picture without buffers
python -m tests.play.web.measure delayed 3   # the same through a delaying network
python -m tests.play.web.measure rooms 300   # lateness of eight rooms, for so many seconds

The word "finger" behind them lifts by touch instead of by mouse, "least" without buffers, and
"unaware" with a second person who does not know the delay.
"""

import asyncio
import dataclasses
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import websockets
from colift.agents.calibration import CALIBRATION
from colift.agents.humans import LIVE_SUBJECT, SUBJECTS, HandLog, Played, SecondPerson
from colift.agents.humans.second_person import SecondPersonParameters
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import read_bundle
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.playing import play
from colift.benchmark.real_lifts.session_folder import SessionFolder
from colift.benchmark.results.baselines import SECOND_PERSON_SPEC
from colift.benchmark.tasks.level.task import LEVEL
from colift.play.rooms.choice import MIXED, PERSON
from colift.play.rooms.scenarios import cue_of
from colift.play.web.sessions import Sessions

from .devtools import browsing
from .driving import Driven
from .network import Network
from .pages import GRIP, MOVING_S, Page, new_session, samples

FINGER = "finger" in sys.argv
LEAST = "?playout=0&delay=0"
QUERY = LEAST if "least" in sys.argv[3:] else ""
CHROMIUM = shutil.which("chromium") or "google-chrome"
POLICIES = ("anticipate", "blend", "copy")


async def cue_for(host, out, partner):
    """Return the cue of the coming lift of a page's session with a partner."""
    await host.ready()
    session = Sessions(out).find(await session_of(host))
    place = SessionFolder(session.folder).played_with(partner)
    return cue_of(session.cue_seed, place, MIXED)


def references(cue, frames=2000):
    """Return the hand references of a simulated person who lifts by a cue [m]."""
    subject = dataclasses.replace(SUBJECTS["S2"], name="live", pull=0.0)
    scenario = Scenario(behaviour="cued", human=cue, trial="1", subject=subject, task=LEVEL)
    (episode,) = play(PolicySpec(text="copy"), scenario, (0,))
    made = episode.trace.human_action.ravel()
    return np.concatenate((made, np.full(max(frames - len(made), 0), made[-1])))


def hand_of(made):
    return lambda time: float(np.interp(time / 0.01 - 1, np.arange(len(made)), made))


def offline(folder, made, partner=None):
    """Return the RMSE of the same lift with the ideal hand, and the partner's name."""
    bundle = read_bundle(folder)
    scenario, episode = bundle.recipe.suite().scenarios[0], bundle.episodes[0]
    log = HandLog.of_references(made[: len(episode.trace.human_action) * 10].tolist())
    ideal = dataclasses.replace(scenario, human=Played(cue=scenario.human.cue, log=log))
    spec = partner or PolicySpec(text=bundle.results["policy"]["name"])
    (again,) = play(spec, ideal, (0,))
    return again.scores["rmse_mm"]


async def reported(folder, seat=0):
    """Return the delays from hand to picture that a person's page reports of a lift [ms]."""
    path = folder.with_name(folder.name + ".times.json")
    while True:
        parts = json.loads(path.read_text()).get(f"seat_{seat}", [])
        if parts and len(parts) == parts[0]["parts"]:
            return [each for part in parts for each in part["delays_ms"]]
        await asyncio.sleep(0.1)


async def alone(url, out, lifts):
    async with browsing(CHROMIUM) as browser:
        ratios = {}
        delays = []
        for policy in POLICIES:
            driven = await Driven.opened(browser, url, FINGER)
            await driven.choose(policy)
            for seed in range(lifts):
                made = references(await cue_for(driven, out, policy))
                start = await gripped(driven)
                end = await driven.move(hand_of(made), start["at"] / 1000)
                if end["type"] != "end":
                    print(policy, seed, end)
                    continue
                folder = await folder_of(driven, out, end)
                ideal = offline(folder, made)
                delays += await reported(folder)
                ratios.setdefault(policy, []).append(end["rmse_mm"] / ideal)
                print(
                    f"{policy:11} {seed:2} browser {end['rmse_mm']:6.2f} offline {ideal:6.2f} mm "
                    f"{100 * (end['rmse_mm'] / ideal - 1):+5.1f} % late {end['late']} "
                    f"starved {end['starved']} U {start['delay']:.0f} P {start['playout']:.0f}",
                    flush=True,
                )
            await driven.page.close()
        for policy, found in ratios.items():
            mean = 100 * (np.exp(np.log(found).mean()) - 1)
            worst = 100 * (np.abs(np.array(found) - 1).max())
            print(f"{policy}: mean {mean:+.2f} %, largest {worst:.1f} %")
        print("hand to picture: p50 {:.1f}, p99 {:.1f} ms".format(*np.percentile(delays, (50, 99))))


async def gripped(*people):
    """Close the hands of all; return the room's message that the lift begins."""
    for driven in people:
        await driven.ready()
    seen = len(people[0].told)
    for driven in people:
        await driven.grip()
    return await people[0].until("start", after=seen)


async def session_of(host):
    return (await host.page.evaluate("location.hash"))[3:].partition(".")[0]


async def folder_of(host, out, end):
    return out / await session_of(host) / end["folder"]


async def pair(url, out, lifts):
    """Two simulated people at two browsers, against the same two offline.

    Offline there is nothing between a hand and an eye. At the browsers there is the delay from hand
    to picture, which the second person sees, and the page tells after each lift. As people do with
    a delay that stays the same, the second person allows for it after a lift of practice: means to
    be less behind by as much. "unaware", it does not.
    """
    known, unaware = 0.0, "unaware" in sys.argv
    async with browsing(CHROMIUM) as browser:
        host = await Driven.opened(browser, url + QUERY, FINGER)
        await host.choose("person")
        link = await host.page.wait_for("document.querySelector('#invite-link').value")
        guest = await Driven.opened(browser, link.replace("#", QUERY + "#"), FINGER)
        ratios = []
        for seed in (lifts, *range(lifts)):
            made = references(await cue_for(host, out, PERSON))
            start = await gripped(host, guest)
            lag = CALIBRATION.partner_lag - known
            partner = SecondPerson(parameters=SecondPersonParameters(lag=lag))
            end, _ = await asyncio.gather(
                host.move(hand_of(made), start["at"] / 1000),
                guest.follow(partner, LIVE_SUBJECT.visual_delay, start),
            )
            if end["type"] != "end":
                print(seed, end)
                continue
            folder = await folder_of(host, out, end)
            delay = np.median(await reported(folder, seat=1)) / 1000
            allowed, known = known, known if unaware else delay
            if seed == lifts:
                continue
            ideal = offline(folder, made, SECOND_PERSON_SPEC)
            ratios.append(end["rmse_mm"] / ideal)
            print(
                f"pair {seed:2} browser {end['rmse_mm']:6.2f} offline {ideal:6.2f} mm "
                f"{100 * (end['rmse_mm'] / ideal - 1):+5.1f} % hand to picture {1000 * delay:.1f} "
                f"known {1000 * allowed:.1f} ms late {end['late']} U {start['delay']:.0f} "
                f"P {start['playout']:.0f}",
                flush=True,
            )
        print(f"pair: mean {100 * (np.exp(np.log(ratios).mean()) - 1):+.2f} %")


async def delays_of(url, out, lifts):
    """Return the delays from event to picture that a page logs without its buffers [ms]."""
    async with browsing(CHROMIUM) as browser:
        driven = await Driven.opened(browser, url + LEAST, FINGER)
        await driven.choose("copy")
        found = []
        for _ in range(lifts):
            made = references(await cue_for(driven, out, "copy"))
            start = await gripped(driven)
            end = await driven.move(hand_of(made), start["at"] / 1000)
            found += await reported(await folder_of(driven, out, end))
    return found


async def least(url, out, lifts):
    delays = await delays_of(url, out, lifts)
    p50, p99 = np.percentile(delays, (50, 99))
    print(f"event to picture: p50 {p50:.1f}, p99 {p99:.1f} ms ({len(delays)} pictures)")


async def delayed(url, out, lifts):
    """Compare delays that pages log with those of the network between."""
    medians = []
    for up, down in ((0.0, 0.0), (0.02, 0.02), (0.05, 0.05), (0.1, 0.1), (0.03, 0.01)):
        with Network(up, down).before(url) as through:
            medians.append(np.median(await delays_of(through, out, lifts)))
        told, added = medians[-1] - medians[0], 1000 * (up + down)
        print(
            f"{1000 * up:.0f} + {1000 * down:.0f} ms: told {told:.1f}, off by {told - added:+.1f}"
        )


async def rooms(url, out, seconds):
    """Let eight people lift at once, and a ninth wait; the rooms say how late they were."""
    url = url.rstrip("/")
    end = time.monotonic() + seconds
    lifting = [asyncio.ensure_future(lift_until(url, end)) for _ in range(8)]
    await asyncio.sleep(20)
    with Page(url, *new_session(url)) as page:
        print("the ninth:", page.until("queued", timeout=5).get("reason"))
    ends = [each for found in await asyncio.gather(*lifting) for each in found]
    times = [json.loads(path.read_text()) for path in out.glob("*/lifts/*.times.json")]
    late = np.concatenate([each["room"]["late_ms"] for each in times])
    p50, p99, p999 = np.percentile(late, (50, 99, 99.9))
    print(
        f"{len(ends)} lifts, {len(late)} frames: late by p50 {p50:.2f}, p99 {p99:.2f}, "
        f"p99.9 {p999:.2f}, most {late.max():.1f} ms"
    )
    print("void:", [each["reason"] for each in ends if each["type"] != "end"])


async def lift_until(url, end):
    """Lift again and again with a hand that follows the cues; return how the lifts ended."""
    session, secret = new_session(url)
    ends, told = [], asyncio.Queue()
    place = url.replace("http://", "ws://") + "/socket"
    async with websockets.connect(place, origin=url, compression=None) as socket:

        async def read():
            async for message in socket:
                if isinstance(message, str):
                    told.put_nowait(json.loads(message))

        async def until(kind, **wanted):
            while True:
                content = await told.get()
                if content["type"] == kind and wanted.items() <= content.items():
                    return content

        async def say(message, **content):
            await socket.send(json.dumps({"type": message, **content}))

        reading = asyncio.ensure_future(read())
        await say("join", session=session, secret=secret, seat=0)
        await until("state", phase="ready")
        await say("choose", partner="copy", kind="mixed")
        while time.monotonic() < end:
            await until("state", phase="ready")
            await say("grip", **GRIP)
            begin = (await until("start"))["at"] / 1000
            sent, last = 0, (0.0, 0.0, 0.0)
            while True:
                while not told.empty() and (content := told.get_nowait()):
                    if content["type"] == "cue":
                        height = reach(last, time.monotonic())
                        last = (begin + content["frame"] / 100 + 0.25, height, content["height"])
                    if content["type"] in ("end", "void"):
                        break
                else:
                    now = time.monotonic()
                    await socket.send(samples(sent, [(1000 * now, reach(last, now))]))
                    sent += 1
                    await asyncio.sleep(1 / 60)
                    continue
                ends.append(content)
                break
        reading.cancel()
    return ends


def reach(movement, now):
    """Return the height of a hand in a movement: its beginning [s], from and to [m]."""
    begin, low, high = movement
    part = min(max((now - begin) / MOVING_S, 0.0), 1.0)
    return low + (high - low) * part**3 * (10 - 15 * part + 6 * part**2)


def main(what, lifts):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        command = [sys.executable, "-m", "colift", "play", "--no-browser", "--port", "0"]
        server = subprocess.Popen(
            [*command, "--out", folder], stdout=subprocess.PIPE, text=True, bufsize=1
        )
        try:
            line = ""
            while "http" not in line:
                line = server.stdout.readline()
                assert line, "the server has ended"
            url = re.search(r"http://\S+", line).group().rstrip("/,.") + "/"
            asyncio.run(KINDS[what](url, out, lifts))
        finally:
            server.terminate()
            server.wait()


KINDS = {each.__name__: each for each in (alone, pair, least, delayed, rooms)}

if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
