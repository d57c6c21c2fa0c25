"""A true bundle is verified, and what cannot be known of it is not claimed."""

import dataclasses
import json

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, play_baselines, shipped_baselines
from colift.benchmark.suites.suite import make_suite, recorded_suite
from colift.benchmark.verification import verify

from .forging import SUITE, edit_arrays, edit_json, edit_rows, mend, refused


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
        assert verdict.results.plain() == json.loads((made / name / "results.json").read_text())
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
        samples = (
            (trial, k / 50, 0.3 * min(k / up, (60 - k) / (60 - up)))
            for trial, up in (("a", 30), ("b", 20))
            for k in range(61)
        )
        path.write_text("trial,t_s,z_m\n" + "".join(f"{a},{b},{c}\n" for a, b, c in samples))
        run = run_suite(PolicySpec(text="copy"), recorded_suite(path).with_timing(0.05, 0.05))
        write_bundle(tmp_path / "recorded", run, results(run, {}).plain())
        path.unlink()
        assert verify(tmp_path / "recorded").ok
        table = tmp_path / "recorded" / "episodes.csv"
        head, first, _ = table.read_text().splitlines()
        assert head.endswith(",failure,rate_hz,range_m,scale,slow_down,inverted")
        assert first.endswith(",50.0,0.3,0.6897,1.724,False")
        kept = table.read_text()
        # Another scale is not the recording's; a table from before there were these columns is.
        table.write_text(kept.replace(",0.6897,", ",0.5,"))
        mend(tmp_path / "recorded")
        assert "not as colift writes it" in refused(
            tmp_path / "recorded", file="episodes.csv, line 2"
        )
        table.write_text("".join(f"{row.rsplit(',', 5)[0]}\n" for row in kept.splitlines()))
        mend(tmp_path / "recorded")
        assert verify(tmp_path / "recorded").ok
        edited = tmp_path / "recorded" / "recordings.csv"
        edited.write_text(edited.read_text().replace("0.3", "0.31", 1))
        mend(tmp_path / "recorded")
        assert "other episodes" in refused(tmp_path / "recorded", file="results.json")

    def test_the_human_human_baseline_is_verified(self, tmp_path):
        suite = make_suite("quick-v1").with_seeds(0, 1).with_partner("human")
        from colift.benchmark.results.baselines import SECOND_PERSON_SPEC

        run = run_suite(SECOND_PERSON_SPEC, suite)
        write_bundle(tmp_path / "baseline", run, results(run, {}).plain())
        assert verify(tmp_path / "baseline").ok

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
        write_bundle(folder, run, results(run, shipped_baselines(suite)).plain())
        assert verify(folder).ok

        def better(content):
            content["summary"]["vs_human"]["mean"] /= 2

        edit_json(folder, "results.json", better)
        mend(folder)
        assert "summary.vs_human.mean says" in refused(folder, file="results.json")

    def test_others_are_played_again(self, tmp_path):
        suite = dataclasses.replace(SUITE, name="one", scenarios=SUITE.scenarios[:1])
        run, folder = run_suite(PolicySpec(text="copy"), suite), tmp_path / "copy"
        write_bundle(folder, run, results(run, play_baselines(suite)).plain())
        assert verify(folder).ok

        def worse(content):
            content["baselines"]["human_human"]["rmse_mm"]["mean"] *= 2

        edit_json(folder, "results.json", worse)
        mend(folder)
        message = refused(folder, file="results.json")
        assert message.startswith("baselines.human_human.rmse_mm.mean says")

    def test_those_of_single_lifts_are_compared(self, tmp_path):
        suite = dataclasses.replace(SUITE, name="one", scenarios=SUITE.scenarios[:1])
        run, folder = run_suite(PolicySpec(text="copy"), suite), tmp_path / "copy"
        human_human = play_baselines(suite)[HUMAN_HUMAN]
        content = results(run, {HUMAN_HUMAN: human_human}).plain()
        write_bundle(folder, run, content, human_human=human_human)
        assert verify(folder).ok
        for value, place, said in (
            ("55.0", {"file": "episodes.csv", "episode": "smooth/S1 seed 4"}, "rmse_mm says 55.0"),
            ("", {"file": "episodes.csv, row 2"}, "human_human_rmse_mm is missing"),
        ):
            edit_rows(folder, lambda rows, value=value: rows[1].update(human_human_rmse_mm=value))
            mend(folder)
            assert said in refused(folder, **place)
        write_bundle(folder, run, results(run, {}).plain(), human_human=human_human)
        assert "results.json has no human_human" in refused(folder, file="episodes.csv")

    def test_unknown_ones_are_refused(self, bundle):
        edit_json(bundle, "results.json", lambda r: r["baselines"].update(rival={}))
        mend(bundle)
        assert refused(bundle, file="results.json") == "there is no baseline 'rival'"
