"""Bundles whose scores another version of the metrics has computed."""

import json
import math
import shutil

import pytest
from colift.base.errors import InputError
from colift.benchmark.bundle import read_bundle, write_bundle
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.verification import verify

from .forging import (
    GONE,
    NEW,
    edit_arrays,
    edit_json,
    edit_table,
    flip,
    mend,
    outdate_metrics,
    refused,
)


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
        assert verdict.results.plain() == json.loads((made / "copy" / "results.json").read_text())
        write_bundle(
            tmp_path / "new", verdict.run, verdict.results.plain(), platform=verdict.platform
        )
        assert verify(tmp_path / "new").ok

    def test_changed_actions_are_refused_all_the_same(self, bundle):
        self.outdate(bundle)
        edit_arrays(bundle, lambda arrays: flip(arrays["action"], (5, 0)))
        mend(bundle)
        assert refused(bundle, episode="smooth/S1 seed 3", step=5)
        assert not verify(bundle).rescorable

    @pytest.mark.slow
    @pytest.mark.parametrize("scoring", [SCORING - 1, SCORING + 1])
    @pytest.mark.parametrize("name", ["copy", "giving"])
    def test_scores_of_other_metrics_are_computed_again(self, made, tmp_path, name, scoring):
        folder = shutil.copytree(made / name, tmp_path / "other")
        outdate_metrics(folder, scoring)
        verdict = verify(folder)
        assert not verdict.findings
        assert verdict.scoring == (scoring, SCORING)
        assert verdict.rescorable
        new = tmp_path / "new"
        write_bundle(new, verdict.run, verdict.results.plain(), platform=verdict.platform)
        for file in (made / name).iterdir():
            assert (new / file.name).read_bytes() == file.read_bytes()
        assert verify(new).ok

    def test_the_scores_of_other_metrics_are_read_as_far_as_both_have_them(self, made, bundle):
        outdate_metrics(bundle, SCORING - 1)
        true = read_bundle(made / "copy").episodes[0].scores
        read = read_bundle(bundle).episodes[0].scores
        assert read.keys() == true.keys()
        assert math.isnan(read[NEW])
        assert read["rmse_mm"] == true["rmse_mm"]

    @pytest.mark.parametrize(
        ("change", "told"),
        [
            (lambda rows: rows[0].__setitem__(1, "who"), "must have behaviour, subject"),
            (lambda rows: rows[0].__setitem__(5, GONE), "no name twice"),
            (lambda rows: rows[2].append("1.0"), "row 2: "),
            (lambda rows: rows[1].__setitem__(5, "much"), "row 1: rmse_mm is 'much'"),
            (lambda rows: rows[1].__setitem__(-1, "step 3: \x1b[2J"), "line 2: not as colift"),
        ],
    )
    def test_a_table_that_no_version_writes_is_refused(self, bundle, change, told):
        outdate_metrics(bundle, SCORING - 1)
        edit_table(bundle, change)
        mend(bundle)
        with pytest.raises(InputError, match=told):
            read_bundle(bundle)
        assert not verify(bundle).rescorable

    def test_other_metrics_are_no_excuse_for_the_lifts(self, bundle):
        outdate_metrics(bundle, SCORING - 1)
        edit_table(bundle, lambda rows: rows[1].__setitem__(3, "4"))
        mend(bundle)
        assert "row 1 is smooth/S1 seed 4" in refused(bundle, episode="smooth/S1 seed 3")
        assert not verify(bundle).rescorable

    def test_of_this_version_another_metric_is_refused(self, bundle):
        outdate_metrics(bundle, SCORING)
        assert "the first line must be behaviour" in refused(bundle, file="episodes.csv")
