"""Every number must follow from the episodes, and every failure fit them."""

import json

import numpy as np
import pytest
from colift.benchmark.bundle import read_bundle
from colift.benchmark.verification import verify

from .forging import edit_json, edit_rows, mend, refused


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

    @pytest.mark.slow
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
        if not claim:  # Nor is there an output of a failure.
            edit_json(giving, "logs.json", lambda logs: logs.pop("2"))
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
