import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import interquartile_mean, mean_with_missing


class TestInterquartileMean:
    def test_is_the_mean_of_the_middle_half(self) -> None:
        assert interquartile_mean([100.0, 3.0, 1.0, 2.0, 4.0, -50.0, 5.0, 6.0]) == 3.5

    def test_leaves_out_whole_values_only(self) -> None:
        assert interquartile_mean([1.0, 2.0, 6.0, 7.0, 90.0]) == 5.0
        assert interquartile_mean([1.0, 2.0, 6.0]) == 3.0
        assert interquartile_mean([4.0]) == 4.0

    def test_ignores_a_quarter_of_failures(self) -> None:
        good = [8.0, 9.0, 10.0, 11.0, 12.0, 9.0]
        assert interquartile_mean([*good, 250.0, 250.0]) < 12.0

    def test_works_along_an_axis_or_over_everything(self) -> None:
        table = np.arange(24.0).reshape(3, 8)
        assert interquartile_mean(table, axis=-1).tolist() == [3.5, 11.5, 19.5]
        assert interquartile_mean(table, axis=0).tolist() == list(np.arange(8.0, 16.0))
        assert interquartile_mean(table) == 11.5

    @pytest.mark.parametrize("values", [[], [1.0, math.nan, 2.0]])
    def test_rejects_nothing_and_nan(self, values: list[float]) -> None:
        with pytest.raises(InputError, match="at least one value and no NaN"):
            interquartile_mean(values)


class TestMeanWithMissing:
    def test_averages_what_is_there_and_counts_what_is_not(self) -> None:
        summary = mean_with_missing([-2.0, math.nan, -4.0, None])
        assert (summary.mean, summary.missing) == (-3.0, 2)

    def test_has_no_mean_when_everything_is_missing(self) -> None:
        summary = mean_with_missing([math.nan, math.nan])
        assert summary.mean is None
        assert summary.missing == 2
