"""Verification: a true bundle passes, and whatever was changed is refused with its place."""

import csv
import dataclasses
import hashlib
import io
import json
import shutil

import numpy as np
import pytest
from colift.agents.errors import InputError, PolicyError
from colift.agents.policies.copy import Copy
from colift.agents.policies.in_process import InProcess
from colift.agents.policies.loading import PolicySpec
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.bundle.arrays import dump_arrays, parse_arrays
from colift.benchmark.executors import process_pool
from colift.benchmark.lift import Lift
from colift.benchmark.recorder import Recorder
from colift.benchmark.references import play_references, shipped_references
from colift.benchmark.runner import run_suite
from colift.benchmark.scores import SCORING, score
from colift.benchmark.suite import make_suite, recorded_suite
from colift.benchmark.verification import verify
from colift.benchmark.verification.tolerance import HEIGHT

SUITE = make_suite("quick-v1").with_seeds(3, 5)


class Giving(Copy):
    """Copies, and gives up in some episodes at step 20."""

    def reset(self, seed):
        super().reset(seed)
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        if self.steps > 20 and observation[0] > 0.03:
            raise PolicyError("too high for me")
        return super().act(observation)

    def internals(self):
        return {"prediction": 0.5}


class GivingSpec(InProcess):
    name = "giving"

    def check(self):
        pass

    def digest(self):
        return "0" * 16

    def make(self):
        return Giving()


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Bundles of true runs, by name."""
    root = tmp_path_factory.mktemp("bundles")
    for name, spec in (("copy", PolicySpec(text="copy")), ("giving", GivingSpec())):
        run = run_suite(spec, SUITE)
        write_bundle(root / name, run, results(run, {}))
    return root


@pytest.fixture
def bundle(made, tmp_path):
    return shutil.copytree(made / "copy", tmp_path / "bundle")


@pytest.fixture
def giving(made, tmp_path):
    return shutil.copytree(made / "giving", tmp_path / "giving")


def mend(folder):
    """Do as a clever forger does: put the files' true hashes into the manifest."""

    def change(manifest):
        for name in manifest["sha256"]:
            data = (folder / name).read_bytes()
            manifest["sha256"][name] = hashlib.sha256(data).hexdigest()

    edit_json(folder, "manifest.json", change)


def edit_json(folder, name, change):
    content = json.loads((folder / name).read_text())
    change(content)
    (folder / name).write_text(json.dumps(content, indent=2) + "\n")


def edit_rows(folder, change):
    path = folder / "episodes.csv"
    rows = list(csv.DictReader(io.StringIO(path.read_bytes().decode(), newline="")))
    rows = change(rows) or rows
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    path.write_bytes(text.getvalue().encode())


def edit_arrays(folder, change):
    path = folder / "traces.npz"
    arrays = {name: a.copy() for name, a in parse_arrays(path.read_bytes(), "traces.npz").items()}
    change(arrays)
    path.write_bytes(dump_arrays(arrays))


def flip(array, index):
    """Change the last bit of one number."""
    array.view(np.uint64)[index] ^= 1


def refused(folder, **place):
    """Assert that a bundle is refused for a place, and return what is wrong there."""
    verdict = verify(folder)
    assert not verdict.ok
    for finding in verdict.findings:
        if all(getattr(finding, name) == value for name, value in place.items()):
            return finding.message
    raise AssertionError([str(finding) for finding in verdict.findings])


def first_row(folder, place):
    """Return the row of the arrays with the first step of the episode at a place."""
    bundle = read_bundle(folder)
    return sum(len(episode.trace.action) for episode in bundle.episodes[:place])


class TestTrue:
    @pytest.mark.parametrize("name", ["copy", "giving"])
    def test_a_true_bundle_is_verified_to_the_bit(self, made, name):
        counted = []
        verdict = verify(made / name, progress=counted.append)
        assert verdict.findings == ()
        assert verdict.ok
        assert verdict.bit_equal
        assert verdict.tolerance_mm is None
        assert not verdict.other_platform
        assert sum(counted) == SUITE.size
        assert verdict.results == json.loads((made / name / "results.json").read_text())
        json.dumps(verdict.plain(), allow_nan=False)

    def test_failures_were_among_them(self, made):
        assert read_bundle(made / "giving").results["summary"]["failed"] == SUITE.size

    def test_fresh_processes_find_the_same(self, made):
        with process_pool(2) as pool:
            verdict = verify(made / "copy", executor=pool)
        assert verdict.ok
        assert verdict.plain() == verify(made / "copy").plain()

    def test_a_recorded_run_is_verified_without_the_recordings_file(self, tmp_path):
        path = tmp_path / "lifts.csv"
        samples = ((trial, k / 50, 0.3 * min(k, 60 - k) / 30) for trial in "ab" for k in range(61))
        path.write_text("trial,t_s,z_m\n" + "".join(f"{a},{b},{c}\n" for a, b, c in samples))
        run = run_suite(PolicySpec(text="copy"), recorded_suite(path).with_timing(0.05, 0.05))
        write_bundle(tmp_path / "recorded", run, results(run, {}))
        path.unlink()
        assert verify(tmp_path / "recorded").ok
        edited = tmp_path / "recorded" / "recordings.csv"
        edited.write_text(edited.read_text().replace("0.3", "0.31", 1))
        mend(tmp_path / "recorded")
        assert "other episodes" in refused(tmp_path / "recorded", file="results.json")

    def test_a_human_team_is_verified(self, tmp_path):
        suite = make_suite("quick-v1").with_seeds(0, 1).with_partner("human")
        from colift.benchmark.references import HumanTeam

        run = run_suite(HumanTeam(), suite)
        write_bundle(tmp_path / "team", run, results(run, {}))
        assert verify(tmp_path / "team").ok

    def test_the_policys_own_words_are_not_verified(self, giving):
        edit_arrays(giving, lambda arrays: arrays["internals/prediction"].fill(7.0))
        edit_json(giving, "results.json", lambda r: r["policy"].update(name="someone else"))
        mend(giving)
        verdict = verify(giving)
        assert verdict.ok
        assert "name" in verdict.plain()["unproven"]


class TestReferences:
    def test_shipped_ones_are_compared(self, tmp_path):
        suite = make_suite("quick-v1")
        run = run_suite(PolicySpec(text="hold"), suite)
        folder = tmp_path / "hold"
        write_bundle(folder, run, results(run, shipped_references(suite)))
        assert verify(folder).ok

        def better(content):
            content["summary"]["vs_human"]["mean"] /= 2

        edit_json(folder, "results.json", better)
        mend(folder)
        assert "summary.vs_human.mean says" in refused(folder, file="results.json")

    def test_others_are_played_again(self, made, bundle):
        run = read_bundle(bundle).run()
        references = play_references(run.suite)
        content = {**json.loads((bundle / "results.json").read_text())}
        fresh = results(run, references)
        fresh["summary"]["step_ms"] = content["summary"]["step_ms"]
        fresh["summary"]["real_time"] = content["summary"]["real_time"]
        write_bundle(bundle, run, fresh)
        assert verify(bundle).ok

        def worse(content):
            content["references"]["human_human"]["rmse_mm"]["mean"] *= 2

        edit_json(bundle, "results.json", worse)
        mend(bundle)
        message = refused(bundle, file="results.json")
        assert message.startswith("references.human_human.rmse_mm.mean says")

    def test_unknown_ones_are_refused(self, bundle):
        edit_json(bundle, "results.json", lambda r: r["references"].update(rival={}))
        mend(bundle)
        assert refused(bundle, file="results.json") == "there is no reference 'rival'"


class TestActions:
    @pytest.mark.parametrize("place", [0, 5])
    @pytest.mark.parametrize("name", ["action", "human_action"])
    def test_one_bit_of_one_action_is_found_with_its_step(self, bundle, name, place):
        episode = SUITE.scenarios[place // 2].name + f" seed {3 + place % 2}"
        row = first_row(bundle, place) + 17
        edit_arrays(bundle, lambda arrays: flip(arrays[name], (row, 0)))
        assert "SHA-256" in refused(bundle, file="traces.npz", episode="")
        mend(bundle)
        message = refused(bundle, file="traces.npz", episode=episode, step=17)
        assert ("human's action" in message) == (name == "human_action")

    @pytest.mark.parametrize(
        "name", ["human_end", "robot_end", "human_velocity", "human_force", "robot_force", "target"]
    )
    def test_one_bit_of_what_follows_is_found_with_its_frame(self, bundle, name):
        edit_arrays(bundle, lambda arrays: flip(arrays[name], 234))
        mend(bundle)
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=23)
        assert message.startswith(f"{name} in frame 234 is ")

    def test_one_bit_of_a_hash_is_found(self, bundle):
        def change(arrays):
            arrays["state"][40, 3] ^= 1

        edit_arrays(bundle, change)
        mend(bundle)
        assert "hash" in refused(bundle, episode="smooth/S1 seed 3", step=40)

    def test_a_human_who_helps_is_found_though_all_else_follows(self, bundle):
        """The cleverest forgery: a true simulation, with a human who does what is easy."""
        told = read_bundle(bundle)
        run = told.run()
        forged = [_with_kind_human(episode, run.suite) for episode in run.episodes[:1]]
        run = dataclasses.replace(run, episodes=(*forged, *run.episodes[1:]))
        assert forged[0].scores.rmse_mm < told.episodes[0].scores.rmse_mm
        write_bundle(bundle, run, results(run, {}))
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=31)
        assert "scripted human's" in message

    def test_actions_of_another_episode_are_no_use(self, bundle):
        def swap(arrays):
            first, second = arrays["steps"][:2]
            both = min(first, second)
            one, other = slice(0, both), slice(first, first + both)
            rows = arrays["action"].copy()
            arrays["action"][one], arrays["action"][other] = rows[other], rows[one]

        edit_arrays(bundle, swap)
        mend(bundle)
        assert refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=0)


def _with_kind_human(episode, suite):
    """Return an episode that was played to its end with a human who stops lifting at step 31."""
    scenario = next(s for s in suite.scenarios if s.behaviour == episode.behaviour)
    lift = Lift(scenario)
    lift.reset(episode.seed)
    recorder, partner = Recorder(lift), Copy()
    partner.reset(0)
    for step, reference in enumerate(episode.trace.human_action.tolist()):
        reference = [0.0] * 10 if step >= 31 else reference
        action = partner.act(lift.partner_observation())
        lift.step(reference, action)
        recorder.step(reference, action.tolist(), {})
    trace = recorder.trace()
    scores = score(lift, trace, failed=False)
    lift.close()
    return dataclasses.replace(episode, trace=trace, scores=scores)


class TestSuite:
    def test_a_swapped_seed_in_the_table_is_named(self, bundle):
        def swap(rows):
            rows[2]["seed"], rows[3]["seed"] = rows[3]["seed"], rows[2]["seed"]

        edit_rows(bundle, swap)
        mend(bundle)
        message = refused(bundle, file="episodes.csv", episode="pause/S2 seed 3")
        assert message == "row 3 is pause/S2 seed 4 instead"

    def test_swapped_seeds_of_the_recipe_are_other_episodes(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(seeds=[4, 3]))
        assert "other episodes" in refused(bundle, file="results.json")
        assert refused(bundle, file="traces.npz", episode="smooth/S1 seed 4", step=0)

    def test_another_seed_with_its_digest_does_not_fit_the_actions(self, bundle):
        other = dataclasses.replace(SUITE, seeds=(3, 9))
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(seeds=[3, 9]))
        edit_json(bundle, "results.json", lambda r: r.update(suite_digest=other.digest))

        def change(rows):
            for row in rows[1::2]:
                row["seed"] = "9"

        edit_rows(bundle, change)
        mend(bundle)
        assert refused(bundle, file="traces.npz", episode="smooth/S1 seed 9", step=0)

    @pytest.mark.parametrize(
        "change",
        [
            {"latency": 0.0},
            {"scenarios": ["smooth/S1", "pause/S2", "jerky/S3", "changing_goal/S4"]},
            {"scenarios": ["smooth/S1", "smooth/S2", "jerky/S3", "changing_goal/S5"]},
        ],
    )
    def test_a_changed_recipe_is_refused(self, bundle, change):
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(change))
        assert "other episodes" in refused(bundle, file="results.json")

    def test_a_recipe_that_makes_nothing_is_refused(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(partner="dog"))
        assert "partner must be" in refused(bundle, file="manifest.json")

    def test_episodes_under_a_famous_name_are_refused(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(suite="standard-v1"))
        edit_json(bundle, "results.json", lambda r: r.update(suite="standard-v1"))
        mend(bundle)
        assert "not those of standard-v1" in refused(bundle, file="manifest.json")

    def test_another_name_in_the_results_is_refused(self, bundle):
        edit_json(bundle, "results.json", lambda r: r.update(suite="standard-v1"))
        mend(bundle)
        assert "'standard-v1'" in refused(bundle, file="results.json")

    @pytest.mark.parametrize("honest", [True, False])
    def test_a_missing_episode_is_named_and_part_of_a_suite_has_no_score(self, bundle, honest):
        told = read_bundle(bundle)
        run = told.run()
        part = dataclasses.replace(run, episodes=run.episodes[:3] + run.episodes[4:])
        content = results(part, {})
        content["summary"]["step_ms"] = told.results["summary"]["step_ms"]
        content["summary"]["real_time"] = told.results["summary"]["real_time"]
        write_bundle(bundle, part, content)
        message = refused(bundle, file="traces.npz", episode="pause/S2 seed 4")
        assert "1 of 8 episodes" in message
        if honest:
            assert len(verify(bundle).findings) == 1
            return
        edit_json(bundle, "results.json", lambda r: r.update(complete=True))
        mend(bundle)
        assert refused(bundle, file="results.json") == "complete says True, should be False"


class TestScores:
    def test_an_edited_score_of_an_episode_is_named(self, bundle):
        def better(rows):
            rows[4]["rmse_mm"] = "5.0"

        edit_rows(bundle, better)
        assert "SHA-256" in refused(bundle, file="episodes.csv", episode="")
        mend(bundle)
        message = refused(bundle, file="episodes.csv", episode="jerky/S3 seed 3")
        assert message.startswith("rmse_mm says 5.0, should be ")

    def test_one_bit_of_a_score_is_found(self, bundle):
        def better(rows):
            value = float(rows[4]["sparc"])
            rows[4]["sparc"] = repr(float(np.nextafter(value, 0)))

        edit_rows(bundle, better)
        mend(bundle)
        message = refused(bundle, file="episodes.csv", episode="jerky/S3 seed 3")
        assert message.startswith("sparc says")

    @pytest.mark.parametrize(
        ("path", "value"),
        [
            ("summary.rmse_mm.mean", 5.0),
            ("summary.failed", 1),
            ("summary.real_time", False),
            ("summary.vs_human", {"mean": 0.5, "ci95": [0.4, 0.6]}),
            ("summary.sparc.missing", -1),
            ("suite_digest", "0" * 16),
            ("fame", "great"),
        ],
    )
    def test_an_edited_number_of_the_results_is_named(self, bundle, path, value):
        def change(content):
            *names, last = path.split(".")
            for name in names:
                content = content[name]
            content[last] = value

        edit_json(bundle, "results.json", change)
        assert "SHA-256" in refused(bundle, file="results.json")
        mend(bundle)
        messages = [str(finding) for finding in verify(bundle).findings]
        assert any(path in message for message in messages)

    def test_an_edited_group_is_named(self, bundle):
        edit_json(bundle, "results.json", lambda r: r["groups"][2]["rmse_mm"].update(mean=1.0))
        mend(bundle)
        assert refused(bundle, file="results.json").startswith("groups[2].rmse_mm.mean says 1.0")

    @pytest.mark.parametrize("value", ["1e999", "NaN", "9" * 400 + ".0", '"5"', "null", "[]"])
    def test_a_number_that_is_none_is_refused(self, bundle, value):
        path = bundle / "results.json"
        mean = json.loads(path.read_text())["summary"]["rmse_mm"]["mean"]
        path.write_text(path.read_text().replace(repr(mean), value, 1))
        mend(bundle)
        assert refused(bundle, file="results.json")

    def test_a_step_that_was_slow_cannot_be_real_time(self, bundle):
        edit_json(bundle, "results.json", lambda r: r["summary"]["step_ms"].update(p99=200.0))
        mend(bundle)
        message = refused(bundle, file="results.json")
        assert message == "summary.real_time says True, should be False"


class TestFailures:
    @pytest.mark.parametrize(
        "claim", ["", "step 3: PolicyError: too high for me", "the table was dropped"]
    )
    def test_a_changed_failure_is_refused(self, giving, claim):
        def change(rows):
            rows[1]["failure"] = claim

        edit_rows(giving, change)
        mend(giving)
        steps = len(read_bundle(giving).episodes[1].trace.action)
        message = refused(giving, file="traces.npz", episode="smooth/S1 seed 4", step=steps)
        assert "the actions end" in message

    def test_a_failure_that_was_none_is_refused(self, bundle):
        def change(rows):
            rows[1]["failure"] = "step 3: PolicyError: bad luck"

        edit_rows(bundle, change)
        mend(bundle)
        message = refused(bundle, file="episodes.csv", episode="smooth/S1 seed 4")
        assert message.endswith("the simulation gives None")

    def test_its_words_are_the_policys_own(self, giving):
        def change(rows):
            rows[1]["failure"] = rows[1]["failure"].replace("too high", "too low")

        edit_rows(giving, change)
        mend(giving)
        assert verify(giving).ok


class TestOtherPlatform:
    def moved(self, folder, offset):
        """Write a bundle whose heights are off, as by other last bits, from another platform."""
        run = read_bundle(folder).run()
        episodes = []
        for number, episode in enumerate(run.episodes):
            trace = dataclasses.replace(
                episode.trace,
                robot_end=episode.trace.robot_end + offset,
                state=~episode.trace.state,
            )
            lift = Lift(run.suite.scenarios[number // 2])
            lift.reset(episode.seed)
            scores = score(lift, trace, failed=False)
            lift.close()
            episodes.append(dataclasses.replace(episode, trace=trace, scores=scores))
        run = dataclasses.replace(run, episodes=tuple(episodes))
        platform = {**read_bundle(folder).platform, "libc": "musl 9"}
        write_bundle(folder, run, results(run, {}), platform=platform)

    def test_a_tolerance_holds_and_is_shown(self, bundle):
        self.moved(bundle, 0.5 * HEIGHT)
        verdict = verify(bundle)
        assert verdict.findings == ()
        assert verdict.ok
        assert not verdict.bit_equal
        assert verdict.tolerance_mm == 0.01
        assert verdict.other_platform["libc"][0] == "musl 9"

    def test_beyond_it_the_bundle_is_refused(self, bundle):
        self.moved(bundle, 1.1 * HEIGHT)
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=0)
        assert "robot_end is 1.1e-05 m rms" in message

    @pytest.mark.parametrize("offset", [0.9, 1.1])
    def test_a_human_who_helps_is_found_there_too(self, bundle, offset):
        def change(arrays):
            arrays["human_action"][20:] += offset * HEIGHT
            arrays["human_action"][:20] += 0.1 * HEIGHT

        edit_arrays(bundle, change)
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
        mend(bundle)
        if offset > 1:
            message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=20)
            assert "scripted human's" in message
        else:
            actions = [f for f in verify(bundle).findings if "human's action" in f.message]
            assert actions == []

    @pytest.mark.parametrize("value", [1e308, -1e308, 1.0])
    @pytest.mark.parametrize("name", ["human_force", "human_velocity", "human_end"])
    def test_forged_series_are_refused_whatever_they_are(self, bundle, name, value):
        edit_arrays(bundle, lambda arrays: arrays[name].fill(value))
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
        mend(bundle)
        assert name in refused(bundle, file="traces.npz", episode="smooth/S1 seed 3")

    def test_equal_bits_need_no_tolerance(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
        verdict = verify(bundle)
        assert verdict.ok
        assert verdict.bit_equal
        assert verdict.tolerance_mm is None
        assert verdict.other_platform

    def test_an_edited_score_is_refused_there_too(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
        edit_json(bundle, "results.json", lambda r: r["summary"]["rmse_mm"].update(mean=5.0))
        mend(bundle)
        assert "summary.rmse_mm.mean says 5.0" in refused(bundle, file="results.json")


class TestScoring:
    def outdate(self, folder):
        def change(content):
            content.update(scoring=SCORING - 1, suite_digest="0" * 16)
            content["summary"]["rmse_mm"]["mean"] = 5.0

        edit_json(folder, "results.json", change)
        mend(folder)

    def test_older_scores_are_computed_again_from_the_actions(self, made, bundle, tmp_path):
        self.outdate(bundle)
        verdict = verify(bundle)
        assert not verdict.ok
        assert verdict.rescorable
        assert verdict.scoring == (SCORING - 1, SCORING)
        assert verdict.results == json.loads((made / "copy" / "results.json").read_text())
        write_bundle(tmp_path / "new", verdict.run, verdict.results, platform=verdict.platform)
        assert verify(tmp_path / "new").ok

    def test_changed_actions_are_refused_all_the_same(self, bundle):
        self.outdate(bundle)
        edit_arrays(bundle, lambda arrays: flip(arrays["action"], (5, 0)))
        mend(bundle)
        assert refused(bundle, episode="smooth/S1 seed 3", step=5)
        assert not verify(bundle).rescorable


class TestMalformed:
    def test_no_folder_is_the_users_mistake(self, tmp_path):
        with pytest.raises(InputError, match="nowhere: no such folder"):
            verify(tmp_path / "nowhere")

    def test_an_empty_folder_is_refused(self, tmp_path):
        assert refused(tmp_path, file="results.json") == "it is missing"

    @pytest.mark.parametrize(
        "name", ["results.json", "episodes.csv", "traces.npz", "manifest.json"]
    )
    @pytest.mark.parametrize("data", [b"", b"\x00" * 100, b"{}", b"PK\x05\x06" + bytes(18)])
    def test_a_file_of_something_else_is_named(self, bundle, name, data):
        (bundle / name).write_bytes(data)
        assert refused(bundle, file=name)

    def test_a_behaviour_that_cannot_be_planned_is_refused(self, bundle):
        """A recording of a lone outlier, of which nothing is left."""
        rows = "".join(f"a,{k / 100},{0.3 * (k == 50)}\n" for k in range(100))
        (bundle / "recordings.csv").write_text("trial,t_s,z_m\n" + rows)
        names = ["recorded/S1/a", "pause/S2", "jerky/S3", "changing_goal/S5"]

        def change(manifest):
            manifest["recipe"]["scenarios"] = names
            manifest["sha256"]["recordings.csv"] = ""

        edit_json(bundle, "manifest.json", change)
        mend(bundle)
        assert not verify(bundle).ok
