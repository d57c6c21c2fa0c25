"""Bundles whose scores another version of the metrics has computed."""

import json

from colift.benchmark.bundle import write_bundle
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.verification import verify

from .forging import edit_arrays, edit_json, flip, mend, refused


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
