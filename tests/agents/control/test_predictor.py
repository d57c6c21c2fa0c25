import numpy as np
import pytest
from colift.agents.control.predictor import DEFAULT_PERIOD, Predictor, PredictorParameters
from colift.agents.estimators.confidence import LITERAL, likelihood
from colift.agents.estimators.motion_filter import MotionFilter, MotionFilterParameters
from colift.agents.estimators.residuals import chi_square_tail
from colift.base.errors import InputError

PRECISION = 0.7e-3 / 3
"""Standard deviation of the motion capture [m]."""
READINGS = [LITERAL, "standard deviation as rho"]


def seen(height, time):
    return np.array([height, 0.0, 0.0, 0.0, time])


def follow(heights, parameters=None, period=0.1):
    """Return the predictions and the confidences."""
    predictor = Predictor(parameters)
    predictor.reset()
    steps = [predictor.step(seen(height, period * k)) for k, height in enumerate(heights)]
    predictions, confidences = zip(*steps, strict=True)
    return predictions, np.array(confidences)


def rise_and_stop(speed=0.1, moving=30, still=30):
    return speed * 0.1 * np.minimum(np.arange(moving + still), moving)


@pytest.mark.parametrize("reading", READINGS)
@pytest.mark.parametrize("forgetting", [0.45, 1.0])
def test_confidence_is_equation_7_of_equation_6_of_past_predictions(reading, forgetting):
    heights = np.cumsum(np.random.default_rng(1).normal(0.0, 2e-3, 40))
    predictions, confidences = follow(
        heights, PredictorParameters(reading=reading, forgetting=forgetting)
    )
    # The first sample has no prediction to be judged by.
    likelihoods = [1.0]
    for k in range(1, len(heights)):
        expected = predictions[k - 1]
        error = 1000 * (heights[k] - expected.height)
        likelihoods.append(likelihood(error, expected.variance, reading))
        weights = forgetting ** np.arange(k + 1)
        explicit = (weights * likelihoods[::-1]).sum() / weights.sum()
        assert confidences[k] == pytest.approx(explicit, rel=1e-12)
    assert np.ptp(confidences) > 0.3


@pytest.mark.parametrize("window", [1, 4])
def test_confidence_by_residuals_is_the_p_value_of_past_predictions(window):
    heights = np.cumsum(np.random.default_rng(1).normal(0.0, 2e-3, 40))
    motion = MotionFilterParameters(measurement_noise=0.3, process_noise=1e6)
    parameters = PredictorParameters(confidence="residuals", window=window, motion=motion)
    predictions, confidences = follow(heights, parameters)
    assert confidences[0] == 1.0
    squares = [
        (1000 * (height - expected.height)) ** 2 / (expected.variance + 0.3)
        for height, expected in zip(heights[1:], predictions, strict=False)
    ]
    for k in range(1, len(heights)):
        latest = squares[max(0, k - window) : k]
        assert confidences[k] == pytest.approx(
            chi_square_tail(sum(latest), len(latest)), rel=1e-9, abs=1e-12
        )
    assert np.ptp(confidences) > 0.5


def test_confidence_does_not_touch_the_predictions():
    heights = rise_and_stop()
    by_residuals = PredictorParameters(confidence="residuals")
    assert follow(heights)[0] == follow(heights, by_residuals)[0]


def test_looking_ahead_changes_nothing():
    looking, plain = Predictor(), Predictor()
    looking.reset()
    plain.reset()
    for k, height in enumerate(rise_and_stop()):
        told, _ = looking.step(seen(height, 0.1 * k))
        assert looking.ahead(0.1 if k == 0 else looking.period) == told
        far = looking.ahead(0.3)
        assert far.variance > told.variance
        assert plain.step(seen(height, 0.1 * k))[0] == told
    plain.reset()
    with pytest.raises(ValueError, match="before the first sample"):
        plain.ahead(0.1)


def test_the_period_is_the_time_between_the_last_two_samples():
    predictor = Predictor()
    predictor.reset()
    periods = []
    for time in (0.0, 0.05, 0.25):
        predictor.step(seen(0.0, time))
        periods.append(predictor.period)
    assert periods == pytest.approx([DEFAULT_PERIOD, 0.05, 0.2])
    predictor.reset()
    assert predictor.period == DEFAULT_PERIOD


def test_predictions_are_the_filters():
    heights = 0.1 * np.sin(0.3 * np.arange(30))
    tracker = MotionFilter()
    tracker.reset(heights[0])
    expected = [tracker.predict(0.1)]
    for height in heights[1:]:
        tracker.update(height)
        expected.append(tracker.predict(0.1))
    told = np.array(follow(heights)[0])
    assert told == pytest.approx(np.array(expected), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_a_still_human_is_expected_to_stay_and_the_robot_is_sure(seed):
    noise = PRECISION * np.random.default_rng(seed).standard_normal(60)
    predictions, confidences = follow(0.1 + noise)
    heights = np.array([prediction.height for prediction in predictions])
    assert heights == pytest.approx(np.full(60, 0.1), abs=3e-3)
    assert confidences.min() > 0.8


def test_a_steady_human_is_predicted_one_step_ahead():
    heights = rise_and_stop()
    predictions, confidences = follow(heights)
    assert predictions[28].height == pytest.approx(heights[29], abs=2e-4)
    assert predictions[28].velocity == pytest.approx(0.1, abs=2e-3)
    assert confidences[28] > 0.95


@pytest.mark.parametrize("period", [0.05, 0.2])
def test_one_step_is_the_time_between_samples(period):
    predictions, _ = follow(0.1 * period * np.arange(120), period=period)
    assert predictions[-1].height == pytest.approx(0.1 * period * 120, abs=2e-4)
    assert predictions[-1].velocity == pytest.approx(0.1, abs=2e-3)


def test_before_a_second_sample_the_step_is_the_papers():
    assert DEFAULT_PERIOD == 0.1
    (prediction,), (confidence,) = follow([0.07])
    assert (prediction.height, confidence) == (pytest.approx(0.07), 1.0)


@pytest.mark.parametrize(
    "parameters",
    [*({"reading": reading} for reading in READINGS), {"confidence": "residuals"}],
    ids=str,
)
def test_an_abrupt_stop_shakes_the_confidence_until_it_is_learned(parameters):
    confidences = follow(rise_and_stop(), PredictorParameters(**parameters))[1]
    assert confidences[30] > 0.95
    assert confidences[31] < 0.6
    assert confidences[31:37].min() < 0.3
    assert confidences[50:].min() > 0.9


def test_an_unexpected_start_shakes_the_confidence():
    confidences = follow(np.concatenate((np.zeros(20), rise_and_stop())))[1]
    assert confidences[20] > 0.95
    assert confidences[21:27].min() < 0.4


def test_wild_jumps_leave_no_confidence():
    confidences = follow(0.05 * (-1.0) ** np.arange(40))[1]
    assert confidences[-1] < 1e-6
    assert (confidences >= 0.0).all()


@pytest.mark.parametrize("shift", [-0.1, 0.2])
def test_heights_are_relative(shift):
    heights = rise_and_stop()
    predictions, confidences = follow(heights)
    moved, same = follow(heights + shift)
    assert same == pytest.approx(confidences, rel=1e-6)
    assert moved[40].height - shift == pytest.approx(predictions[40].height, abs=1e-9)


def test_reset_forgets():
    used, fresh = Predictor(), Predictor()
    used.reset()
    for k in range(10):
        used.step(seen(0.03 * (k % 3), 0.2 * k))
    used.reset()
    fresh.reset()
    for k, height in enumerate(rise_and_stop()):
        assert used.step(seen(height, 0.1 * k)) == fresh.step(seen(height, 0.1 * k))


def test_a_lost_marker_is_refused():
    predictor = Predictor()
    predictor.reset()
    with pytest.raises(ValueError, match="must be finite"):
        predictor.step(seen(np.nan, 0.0))


def test_forgetting_is_the_papers_by_default():
    assert PredictorParameters().forgetting == 0.45


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"reading": "x"}, "'variance as rho', 'standard deviation as rho', got 'x'"),
        ({"confidence": "x"}, "confidence must be one of 'likelihood', 'residuals', got 'x'"),
        ({"forgetting": 0.0}, r"forgetting must be in \(0, 1\], got 0.0"),
        ({"forgetting": np.nan}, "forgetting"),
        ({"window": 0}, "window must be from 1 to 100 residuals, got 0"),
    ],
)
def test_impossible_parameters_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        PredictorParameters(**values)
