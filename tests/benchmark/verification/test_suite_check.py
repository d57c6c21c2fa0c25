"""Only the episodes of the suite, all of them, have a score."""

import dataclasses
import json

import pytest
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification import verify
from colift.benchmark.verification.content_check import suite_label

from .forging import SUITE, edit_json, edit_rows, mend, refused


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
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 4", step=0)
        assert "human's action" in message

    def test_another_seed_with_its_digest_does_not_fit_the_actions(self, bundle):
        other = dataclasses.replace(SUITE, seeds=(3, 9))
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(seeds=[3, 9]))
        edit_json(bundle, "results.json", lambda r: r.update(suite_digest=other.digest))

        def change(rows):
            for row in rows[1::2]:
                row["seed"] = "9"

        edit_rows(bundle, change)
        mend(bundle)
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 9", step=0)
        assert "human's action" in message

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
        assert "the name standard-v1, but other episodes" in refused(bundle, file="manifest.json")

    def test_another_name_in_the_results_is_refused(self, bundle):
        edit_json(bundle, "results.json", lambda r: r.update(suite="standard-v1"))
        mend(bundle)
        assert "'standard-v1'" in refused(bundle, file="results.json")

    @pytest.mark.parametrize(
        "name",
        [
            *("standard\u2011v1", "standard-v1\u200b", "st\u0430ndard-v1", "standard-v1 "),
            *(" standard-v1", "standard-v1\n", "", "a  b", "x" * 201, "\ud800", "a/b", "a'b"),
        ],
    )
    def test_a_name_that_is_not_plain_is_refused(self, bundle, name):
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(suite=name))
        edit_json(bundle, "results.json", lambda r: r.update(suite=name))
        mend(bundle)
        assert "the suite's name is" in refused(bundle, file="manifest.json")

    @pytest.mark.parametrize("name", ["Standard-v1", "standard-v1 (latency 0.1 s)", "standard-v1."])
    def test_a_suite_of_ones_own_is_called_that_whatever_its_name(self, bundle, name):
        edit_json(bundle, "manifest.json", lambda m: m["recipe"].update(suite=name))
        edit_json(bundle, "results.json", lambda r: r.update(suite=name))
        mend(bundle)
        verdict = verify(bundle)
        assert verdict.ok
        assert verdict.suite == "a suite of its own: 8 lifts, latency 0.1 s"
        assert verdict.plain()["suite"] == verdict.suite
        assert "tandard" not in json.dumps(verdict.plain())

    def test_a_shipped_suite_is_known_by_its_episodes(self):
        suite = make_suite("standard-v1")
        assert suite_label(dataclasses.replace(suite, name="mine")) == "standard-v1"
        own = suite.with_timing(0.0, 0.02).with_seeds(0, 1)
        label = "a suite of its own: 300 lifts, latency 0 s, control period 0.02 s"
        assert suite_label(own) == label

    @pytest.mark.parametrize("honest", [True, False])
    def test_a_missing_episode_is_named_and_part_of_a_suite_has_no_score(self, bundle, honest):
        told = read_bundle(bundle)
        run = told.run()
        part = dataclasses.replace(run, episodes=run.episodes[:3] + run.episodes[4:])
        content = results(part, {}).plain()
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
