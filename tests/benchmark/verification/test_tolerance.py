"""A bundle of another platform: within a tolerance, which is shown."""

import dataclasses

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.episode.lift import Lift
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import shipped_baselines
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification import verify
from colift.benchmark.verification.deviation import HEIGHT

from .forging import edit_arrays, edit_json, flip, mend, refused, rewrite


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
            scores = lift.task.score(lift, trace, failed=False)
            lift.close()
            episodes.append(dataclasses.replace(episode, trace=trace, scores=scores))
        run = dataclasses.replace(run, episodes=tuple(episodes))
        platform = {**read_bundle(folder).platform, "libc": "musl 9"}
        rewrite(folder, run, platform)

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

    @pytest.mark.parametrize("offset", [0.1, 1.1])
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

    @pytest.mark.slow
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

    @pytest.mark.slow
    @pytest.mark.parametrize("name", ["vectors", "linear_algebra", "vector_extensions"])
    def test_what_only_policies_use_gives_no_tolerance(self, bundle, name):
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update({name: "another"}))
        assert verify(bundle).policies_differ == (name != "vectors")
        edit_arrays(bundle, lambda arrays: flip(arrays["robot_end"], 234))
        mend(bundle)
        verdict = verify(bundle)
        assert verdict.ok == (name == "vectors")  # An unknown name may be of anything.
        assert (verdict.tolerance_mm is None) == (name != "vectors")

    def test_equal_bits_leave_no_tolerance_for_scores(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))

        def better(content):
            content["summary"]["rmse_mm"]["mean"] *= 1 - 1e-9

        edit_json(bundle, "results.json", better)
        mend(bundle)
        assert "summary.rmse_mm.mean says" in refused(bundle, file="results.json")

    def test_shipped_baselines_leave_no_tolerance_for_the_ratio(self, tmp_path):
        suite = make_suite("quick-v1")
        run, folder = run_suite(PolicySpec(text="hold"), suite), tmp_path / "hold"
        write_bundle(folder, run, results(run, shipped_baselines(suite)).plain())
        edit_arrays(folder, lambda arrays: flip(arrays["robot_end"], 234))
        edit_json(folder, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
        mend(folder)
        verdict = verify(folder)
        assert verdict.ok
        assert verdict.tolerance_mm == 0.01

        def better(content):
            for path in (content["summary"]["vs_human"], content["groups"][0]["rmse_mm"]):
                path["mean"] *= 0.9905

        edit_json(folder, "results.json", better)
        mend(folder)
        assert "summary.vs_human.mean says" in refused(folder, file="results.json")

    def test_an_edited_score_is_refused_there_too(self, bundle):
        edit_json(bundle, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
        edit_json(bundle, "results.json", lambda r: r["summary"]["rmse_mm"].update(mean=5.0))
        mend(bundle)
        assert "summary.rmse_mm.mean says 5.0" in refused(bundle, file="results.json")
