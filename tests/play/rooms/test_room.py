"""Rooms in simulated time: lifts by hands, what they prove, and what ends them."""

import hashlib
import json

import numpy as np
import pytest
from colift.agents.humans import Cued, HandLog, LoggedHand
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.bundle.arrays import dump_arrays
from colift.benchmark.bundle.json_text import dump_json
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.real_lifts.session_folder import lift_folders
from colift.benchmark.real_lifts.suites import played_lifts
from colift.benchmark.suites.suite import recorded_suite
from colift.benchmark.verification.verify import verify
from colift.play.rooms import partnership
from colift.play.rooms.messages import HandSamples, dump_samples, parse_frame
from colift.play.rooms.room import Room, RoomConfig
from colift.play.rooms.seats import ALL

POLICIES = {name: PolicySpec(text=name) for name in ("anticipate", "copy")}


class Table:
    """A room in simulated time, and pages whose people follow the cues."""

    def __init__(self, folder, policies=POLICIES, **config):
        self.room = Room(RoomConfig(folder=folder, policies=policies, **config))
        self.now = 100.0
        self.told = []
        self.frames = {}

    def take(self, messages):
        for seat, message in messages:
            if isinstance(message, bytes):
                self.frames.setdefault(seat, []).append(parse_frame(message))
            else:
                self.told.append((seat, json.loads(message)))

    def say(self, seat, **content):
        self.take(self.room.receive(seat, json.dumps(content), self.now))

    def last(self, kind):
        return next(told for _, told in reversed(self.told) if told["type"] == kind)

    def prepare(self):
        while self.room.has_work:
            self.take(self.room.work())

    def grip(self, seat, clock=5.0, **more):
        offset = 1000 * (self.now - clock)
        self.say(seat, type="grip", offset=offset, playout=12, input={"preset": "mouse"}, **more)

    def lift(self, hands, clock=5.0, step=0.004, until=None):
        """Let time pass with hands that are functions of the time of the lift [s] -> [m]."""
        start = self.last("start")
        begin = start["at"] / 1000
        shift = self.now - clock
        sent = dict.fromkeys(hands, 0)
        while self.room.due is not None and (until is None or self.now < begin + until):
            self.now += step
            for seat, hand in hands.items():
                sample = (self.now - 0.001 - shift, hand(self.now - 0.001 - begin))
                data = dump_samples(HandSamples(first=sent[seat], samples=(sample,)))
                sent[seat] += 1
                self.take(self.room.receive(seat, data, self.now))
            if self.room.due is not None and self.room.due <= self.now:
                self.take(self.room.tick(self.now))
        if self.room.due is None and self.room.has_work:
            self.take(self.room.work())


def hand_of(cue):
    """Return a hand that moves as the cue asks, a fifth of a second late."""
    target = cue.plan(None, 0).target

    def height(time):
        place = min(max((time - 0.2) / 0.01, 0), len(target) - 1)
        return float(np.interp(place, np.arange(len(target)), target))

    return height


@pytest.fixture
def table(tmp_path):
    made = Table(tmp_path / "session", cue_seed=3)
    made.take(made.room.join(0))
    yield made
    made.room.close()


def lifted(table, **more):
    table.prepare()
    table.grip(0, **more)
    cue = table.room._lifting.cue
    table.lift({0: hand_of(cue)})
    return table.last("end")


def test_a_lift_is_scored_kept_and_verified_to_the_bit(table, tmp_path):
    end = lifted(table)
    assert end["failure"] is None
    assert 0.5 < end["rmse_mm"] < 15
    assert end["ghost_rmse_mm"] > 1
    folder = tmp_path / "session" / end["folder"]
    assert lift_folders(tmp_path / "session") == [folder]
    verdict = verify(folder)
    assert verdict.findings == ()
    assert verdict.bit_equal
    assert verdict.run.episodes[0].scores["rmse_mm"] == end["rmse_mm"]


def test_cues_are_told_to_the_leader_when_they_appear(table):
    lifted(table)
    cues = [told for seat, told in table.told if told["type"] == "cue"]
    assert [cue["frame"] for cue in cues] == sorted(cue["frame"] for cue in cues)
    assert cues[-1]["height"] == 0
    assert len(cues) in (2, 3)


def test_every_frame_is_shown_with_both_ends(table):
    end = lifted(table)
    frames = [shown.frame for shown, _, _ in table.frames[0]]
    assert frames == list(range(1, table.last("start")["frames"] + 1))
    assert end["late"]["frames"] == 0
    used = [used for _, _, used in table.frames[0]]
    assert used == sorted(used)


def test_a_hand_that_lets_go_is_no_lift_and_the_cue_comes_again(table, tmp_path):
    table.prepare()
    table.grip(0)
    first = table.room._lifting.cue
    table.lift({0: hand_of(first)}, until=2.0)
    table.say(0, type="release")
    assert "let go" in table.last("void")["reason"]
    assert lift_folders(tmp_path / "session") == []
    end = lifted(table)
    assert end["lift"] == 1
    assert table.room._session.played_with("anticipate") == 1


def test_a_gap_makes_a_lift_void(table):
    table.prepare()
    table.grip(0)
    table.lift({0: hand_of(table.room._lifting.cue)}, until=2.0)
    table.now += 0.16
    table.take(table.room.tick(table.now))
    assert "busy" in table.last("void")["reason"]


def test_a_page_that_falls_silent_makes_a_lift_void(table):
    table.prepare()
    table.grip(0)
    table.lift({0: hand_of(table.room._lifting.cue)}, until=1.0)
    table.lift({})
    assert table.now < table.last("start")["at"] / 1000 + 3.1
    assert "nothing was heard" in table.last("void")["reason"]


def test_partners_are_compared_on_the_same_movement(table):
    end = lifted(table)
    table.prepare()
    assert end["compared"]
    standing = table.last("standing")
    assert [each["name"] for each in standing["policies"]] == ["anticipate", "copy"]
    assert standing["policies"][0]["rmse_mm"] == pytest.approx(end["rmse_mm"], rel=1e-9)


def test_a_partner_that_fails_leaves_no_movement_to_compare(tmp_path):
    (tmp_path / "mine.py").write_text(
        "class Failing:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): raise ValueError('no idea')\n"
    )
    failing = PolicySpec(text=f"{tmp_path}/mine.py:Failing")
    table = Table(tmp_path / "session", {"Failing": failing, **POLICIES})
    table.take(table.room.join(0))
    end = lifted(table)
    table.prepare()
    assert end["failure"] == "step 0: ValueError: no idea"
    assert not end["compared"]
    assert "standing" not in {told["type"] for _, told in table.told}
    table.room.close()


@pytest.mark.parametrize("partner", ["person", "person as robot", "simulated person"])
def test_two_people_lift_and_it_is_proved(table, tmp_path, partner):
    table.take(table.room.join(1))
    table.say(0, type="choose", partner=partner, kind="smooth")
    table.prepare()
    table.grip(0)
    hands = {}
    if partner != "simulated person":
        assert table.room.due is None
        table.grip(1)
        follow = hand_of(table.room._lifting.cue)
        hands[1] = lambda time: follow(time - 0.1)
    hands[0] = hand_of(table.room._lifting.cue)
    table.lift(hands)
    end = table.last("end")
    assert end["failure"] is None
    verdict = verify(tmp_path / "session" / end["folder"])
    assert verdict.findings == ()
    assert verdict.bit_equal
    leaders = {seat for seat, told in table.told if told["type"] == "cue"}
    assert leaders == {0}


def test_what_cannot_be_used_is_a_fault_and_the_room_goes_on(table):
    table.prepare()
    table.grip(0)
    for message in (b"\x01", b"\x07" + bytes(8), "[]", "nonsense", '{"type": "dance"}'):
        table.take(table.room.receive(0, message, table.now))
        assert table.last("fault")["message"]
    table.say(1, type="choose", partner="copy")
    assert "seat" in table.last("fault")["message"]
    again = dump_samples(HandSamples(first=7, samples=((1.0, 0.0),)))
    table.take(table.room.receive(0, again, table.now))
    assert "sample 0 must be next" in table.last("fault")["message"]


def test_forged_samples_are_refused_and_counted(table):
    table.prepare()
    table.grip(0)
    hand = table.room._lifting.hands[0]
    for time, height in ((1.0, 0.0), (0.5, 0.0), (1.0, 0.1), (float("nan"), 0), (2.0, 9.0)):
        hand.add(time, height)
    assert (hand.samples, hand.refused) == (1, 4)


def test_references_can_be_published_without_the_samples():
    references = np.random.default_rng(1).normal(size=300).cumsum() * 1e-3
    hand = LoggedHand(HandLog.of_references(references.tolist()))
    assert [hand.next() for _ in references] == references.tolist()


def test_a_start_is_for_all_seats(table):
    lifted(table)
    assert [seat for seat, told in table.told if told["type"] == "start"] == [ALL]
    assert Cued(kind="pause", seed=1).cues() != Cued(kind="pause", seed=2).cues()


def test_a_session_is_played_again_by_any_policy_to_the_same_bits(table, tmp_path):
    """The same policy gives the same commands on the logged movement; another one can be asked."""
    end = lifted(table)
    (lift,) = lift_folders(tmp_path / "session")
    suite = played_lifts(tmp_path / "session").suite
    again = run_suite(PolicySpec(text="anticipate"), suite).episodes[0]
    logged = read_bundle(lift).episodes[0]
    assert again.scores == logged.scores
    assert again.trace.action.tobytes() == logged.trace.action.tobytes()
    assert again.trace.state.tobytes() == logged.trace.state.tobytes()
    other = run_suite(PolicySpec(text="copy"), suite).episodes[0]
    assert other.scores["rmse_mm"] > end["rmse_mm"]


def test_a_run_on_a_session_is_a_bundle_without_the_pointers_samples(table, tmp_path):
    lifted(table)
    suite = played_lifts(tmp_path / "session").suite
    run = run_suite(PolicySpec(text="copy"), suite)
    write_bundle(tmp_path / "bundle", run, results(run, {}).plain())
    assert verify(tmp_path / "bundle").findings == ()
    human = read_bundle(tmp_path / "bundle").recipe.suite().scenarios[0].human
    assert human.log.times.tolist() == [(i + 1) * 0.01 for i in range(len(human.log.times))]


def test_recordings_of_a_session_are_read_as_any_others(table, tmp_path):
    lifted(table)
    (scenario,) = recorded_suite(tmp_path / "session" / "recordings.csv").scenarios
    assert scenario.trial.startswith("001-")


def mended(folder):
    """Mend the hashes of a bundle that was changed, as a forger would."""
    manifest = json.loads((folder / "manifest.json").read_text())
    for name in manifest["sha256"]:
        manifest["sha256"][name] = hashlib.sha256((folder / name).read_bytes()).hexdigest()
    (folder / "manifest.json").write_bytes(dump_json(manifest))


def flipped(arrays):
    arrays["human_heights"][200] += 1e-9


def dropped(arrays):
    for name in ("human_times", "human_heights", "human_frames"):
        arrays[name] = np.delete(arrays[name], 200)
    arrays["human_samples"] -= 1


def invented(arrays):
    for name in ("human_times", "human_heights", "human_frames"):
        value = arrays[name][200:202].mean() if name != "human_frames" else arrays[name][201]
        arrays[name] = np.insert(arrays[name], 201, value)
    arrays["human_samples"] += 1


def reordered(arrays):
    heights = arrays["human_heights"]
    fastest = int(np.diff(heights).argmax())
    heights[fastest], heights[fastest + 1] = heights[fastest + 1], heights[fastest]


def arrived_earlier(arrays):
    arrays["human_frames"][200:] -= 5


@pytest.mark.slow
@pytest.mark.parametrize("forge", [flipped, dropped, invented, reordered, arrived_earlier])
def test_a_forged_sample_is_found_though_all_hashes_fit(table, tmp_path, forge):
    end = lifted(table)
    folder = tmp_path / "session" / end["folder"]
    arrays = {name: each.copy() for name, each in np.load(folder / "inputs.npz").items()}
    forge(arrays)
    (folder / "inputs.npz").write_bytes(dump_arrays(arrays))
    mended(folder)
    assert verify(folder).findings != ()


COUNTS = '''
class Policy:
    """Lowers its hand by as many tenths of a millimetre as it has begun lifts."""

    def begin_session(self):
        self.lifts = 0

    def reset(self, seed):
        self.lifts += 1

    def act(self, observation):
        return [-1e-4 * self.lifts if observation[2] < 0.0005 else 0.0]
'''


@pytest.fixture
def counting(tmp_path):
    """A room whose policy counts the lifts with its person."""
    (tmp_path / "counts.py").write_text(COUNTS)
    path = f"{tmp_path / 'counts.py'}:Policy"
    made = Table(tmp_path / "session", {"counts": PolicySpec(text=path)} | POLICIES, cue_seed=3)
    made.take(made.room.join(0))
    yield made
    made.room.close()


def test_a_policy_goes_on_with_its_person_until_another_is_chosen(counting, tmp_path):
    def begun():
        end = lifted(counting)
        (episode,) = read_bundle(tmp_path / "session" / end["folder"]).episodes
        return round(-1e4 * float(episode.trace.action[0, 0])), len(end["session"]["rmse_mm"])

    assert [begun(), begun()] == [(1, 1), (2, 2)]
    counting.say(0, type="choose", partner="counts")
    assert begun() == (1, 1)
    assert counting.last("end")["session"]["lifts"] == partnership.LIFTS


def test_a_session_ends_after_its_lifts(counting, monkeypatch):
    monkeypatch.setattr(partnership, "LIFTS", 2)
    assert [len(lifted(counting)["session"]["rmse_mm"]) for _ in range(3)] == [1, 2, 1]
