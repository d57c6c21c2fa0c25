"""Scores beside those of the recorded pairs themselves."""

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.pairs.coordination import coordination
from colift.benchmark.results.baselines import HUMAN_HUMAN
from colift.benchmark.validity.playing import play_source
from colift.benchmark.validity.sources import source_of

TIMES = np.arange(0.0, 4.0, 0.01)


def rise(time, top, peak):
    return top * np.exp(-(((time - peak) / 0.7) ** 2))


def write(path, far=4):
    """Write four lifts of two pairs, the far end 0.05 s late; all but the first ``far`` without."""
    rows = [
        f"{i},{'AB'[i % 2]},{t:.2f},{rise(t, 0.15 + 0.02 * i, 1.6 + 0.2 * i):.6f},"
        + (f"{rise(t - 0.05, 0.15 + 0.02 * i, 1.6 + 0.2 * i):.6f}" if i < far else "")
        for i in range(4)
        for t in TIMES
    ]
    path.write_text("trial,person,t_s,z_m,z_far_m\n" + "\n".join(rows) + "\n")
    return path


SPECS = {name: PolicySpec(text=name) for name in ("hold", "copy")}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "lifts.csv"


def test_policies_and_two_people_are_compared_with_the_pairs_in_the_recorded_part(path):
    source = source_of(write(path, far=3), as_recorded=True)
    assert (source.name, source.kind) == ("lifts as recorded", "as_recorded")
    scores = play_source(SPECS, source)
    beside = scores.beside
    own = [coordination(source.pairs[f"{i}"].ends).rmse_mm for i in range(3)]
    assert beside.pairs.tolist() == own
    assert beside.pairs_mm.value == pytest.approx(np.mean(own))
    # The whole lift has rests besides, in which everybody is nearly level.
    assert (beside.errors["hold"] > scores.errors["hold"][:3]).all()
    lifted = [1000 * np.sqrt(np.mean(source.pairs[f"{i}"].ends.near ** 2)) for i in range(3)]
    assert beside.errors["hold"] == pytest.approx(lifted, rel=0.15)  # The arm yields.
    ratio = np.exp(np.mean(np.log(beside.errors["hold"] / own)))
    assert beside.ratio("hold").value == pytest.approx(ratio)
    assert 0.3 < beside.ratio(HUMAN_HUMAN).value < 3.0


def test_lifts_of_another_size_and_pace_are_not_compared_with_the_pairs(path):
    assert play_source(SPECS, source_of(write(path))).beside is None


def test_one_pair_has_no_ratio_of_its_own(path):
    assert play_source(SPECS, source_of(write(path, far=1), as_recorded=True)).beside is None
