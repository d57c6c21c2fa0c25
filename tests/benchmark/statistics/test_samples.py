"""Resampling: a large sample is drawn in parts, and the numbers are those of a draw at once."""

import numpy as np
from colift.benchmark.statistics import samples

SIZES = (3000, 1, 700, 2)


def test_a_large_sample_is_drawn_in_parts_and_its_statistics_are_the_same():
    places = np.random.default_rng(5).permutation(sum(SIZES))
    members = np.split(places.astype(np.intp), np.cumsum(SIZES)[:-1])
    values = np.random.default_rng(6).random(sum(SIZES))
    blocks = []

    def mean(drawn):
        blocks.append(drawn.size)
        return values[drawn].mean(axis=-1)

    found = samples.resampled(mean, members, 2000, seed=3)
    whole = values[samples.resample(members, 2000, 3)].mean(axis=-1)
    assert found.tobytes() == whole.tobytes()
    assert len(blocks) > 1
    assert max(blocks) <= samples.BLOCK < samples.MOST_DRAWN < sum(blocks)
