"""Learning to anticipate: a perceptron that forecasts motion, fitted to lifts of new people.

It is learned in rounds, as in dataset aggregation (S. Ross, G. Gordon, D. Bagnell, "A reduction of
imitation learning and structured prediction to no-regret online learning", AISTATS 2011): people
yield to the robot, so that they move a little differently with each policy. In the first round the
robot extrapolates; in each further one it anticipates with the model learned from all earlier
rounds.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from functools import partial
from importlib.metadata import version
from typing import Any, Final, NamedTuple

import numpy as np
from colift.agents.control.anticipation import Anticipation, FeatureWindow
from colift.agents.estimators.perceptron import Perceptron
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import TRAINING_SEEDS
from colift.benchmark.training.data import LEADS, Timing, TrainingData, training_data
from colift.benchmark.training.population import CURRICULUM
from colift.benchmark.training.scikit import import_sklearn, reproducible_fit
from numpy.typing import NDArray

FIRST_SEED: Final = TRAINING_SEEDS[0]
"""Seed of the first lift, far from those of the suites, the calibration and the demonstrations."""

LAST_SEED: Final = TRAINING_SEEDS[-1]
"""Last seed for learning: from 200000 on, policies are compared on people that none of them has
met."""

LIFTS: Final = 1500
"""Lifts per round."""

ROUNDS: Final = 2
"""Rounds; a third makes no visible difference."""

HIDDEN: Final = (64, 64, 64)
"""Units of the hidden layers."""

STAGES: Final = ((2e-3, 6), (5e-4, 6), (1e-4, 4))
"""Learning rate and passes through the data of each stage of the fit."""

BATCH: Final = 512
"""Samples of a step of the fit."""

CHUNK: Final = 100_000
"""Most samples that are evaluated at once when the fit is judged: more would fill the memory."""


def fit(
    data: TrainingData, *, hidden: Sequence[int] = HIDDEN, seed: int = 0
) -> tuple[Perceptron, NDArray[np.float64]]:
    """Fit a perceptron to training data by Adam, or a linear map exactly, in mean squared error.

    All outcomes have equal weight: errors are relative to those of the best linear function. The
    fit is scikit-learn's, in one thread, so that the same data give the same bits.

    Returns
    -------
    tuple
        The perceptron, and the root mean square error of each outcome.

    Raises
    ------
    InputError
        If scikit-learn is not installed.
    """
    neural_network = import_sklearn("neural_network")
    centre = data.inputs.mean(axis=0, dtype=np.float64)
    deviation = data.inputs.std(axis=0, dtype=np.float64) + 1e-9
    inputs = ((data.inputs - centre) / deviation).astype(np.float32)
    with reproducible_fit():
        affine = np.hstack((inputs, np.ones((len(inputs), 1), np.float32)))
        normal = affine.T @ affine + np.eye(affine.shape[1])
        line = np.linalg.solve(normal, affine.T @ data.outcomes)
        gain = (data.outcomes - affine @ line).std(axis=0, dtype=np.float64) + 1e-9
        weights, biases = [line[:-1] / gain], [line[-1] / gain]
        if hidden:
            network = neural_network.MLPRegressor(
                hidden_layer_sizes=tuple(hidden),
                batch_size=min(BATCH, len(inputs)),
                warm_start=True,
                random_state=seed,
                alpha=1e-6,
            )
            for rate, passes in STAGES:
                network.set_params(learning_rate_init=rate, max_iter=passes)
                network.fit(inputs, (data.outcomes / gain).astype(np.float32))
            weights, biases = network.coefs_, network.intercepts_
        perceptron = Perceptron(
            centre=centre,
            deviation=deviation,
            weights=tuple(weight.astype(np.float64) for weight in weights),
            biases=tuple(bias.astype(np.float64) for bias in biases),
            gain=gain,
        )
        squares = sum(
            ((perceptron(data.inputs[some]) - data.outcomes[some]) ** 2).sum(axis=0)
            for some in np.array_split(np.arange(len(inputs)), len(inputs) // CHUNK + 1)
        )
    return perceptron, np.sqrt(squares / len(inputs))


def collect_training_data(
    seeds: range,
    *,
    model: Anticipation | None,
    window: FeatureWindow,
    behaviours: Sequence[str],
    timing: Timing,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> TrainingData:
    """Return the training data of lifts on these seeds; see :func:`.training_data`.

    Raises
    ------
    InputError
        If there is no seed, or one is not for learning.
    """
    if not seeds:
        raise InputError("there must be at least 1 lift to learn from")
    if not FIRST_SEED <= seeds[0] <= seeds[-1] <= LAST_SEED:
        raise InputError(
            f"seeds for learning are {FIRST_SEED} to {LAST_SEED}, others are for tests; "
            f"got {seeds[0]} to {seeds[-1]}"
        )
    play = partial(
        training_data,
        model=model,
        window=window,
        behaviours=behaviours,
        timing=timing,
    )
    parts = []
    for part in map(play, seeds) if executor is None else executor.map(play, seeds, chunksize=8):
        parts.append(part)
        progress(1)
    return TrainingData.join(parts)


class Lesson(NamedTuple):
    """The result of a round of learning."""

    model: Anticipation
    data: TrainingData
    """All data from which it was learned."""


def learn_anticipation(
    *,
    lifts: int = LIFTS,
    rounds: int = ROUNDS,
    hidden: Sequence[int] = HIDDEN,
    timing: Timing | None = None,
    first_seed: int = FIRST_SEED,
    behaviours: Sequence[str] = CURRICULUM,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> Iterator[Lesson]:
    """Yield the lesson of each round; the last one is the result.

    Parameters
    ----------
    lifts, rounds
        Lifts of a round, and rounds.
    hidden
        Units of the hidden layers.
    timing
        Latency and control period.
    first_seed
        Seed of the first lift.
    behaviours
        Behaviours of the people, see :func:`.scenario`.
    executor
        Plays the lifts; None plays them in this process.
    progress
        Called with the number of lifts that were finished since the last call.

    Raises
    ------
    InputError
        If scikit-learn is not installed, or as :func:`collect_training_data`.
    """
    import_sklearn("neural_network")
    timing = timing or Timing()
    window = window_for(timing)
    model: Anticipation | None = None
    data: TrainingData | None = None
    for number in range(rounds):
        first = first_seed + number * lifts
        part = collect_training_data(
            range(first, first + lifts),
            model=model,
            window=window,
            behaviours=behaviours,
            timing=timing,
            executor=executor,
            progress=progress,
        )
        data = part if data is None else TrainingData.join((data, part))
        about = {
            "seeds": [first_seed, first + lifts - 1],
            "rounds": number + 1,
            "behaviours": list(behaviours),
        }
        model = learned(data, window, timing, hidden=hidden, provenance=about)
        yield Lesson(model, data)


def learned(
    data: TrainingData,
    window: FeatureWindow,
    timing: Timing,
    *,
    hidden: Sequence[int] = HIDDEN,
    provenance: Mapping[str, Any],
) -> Anticipation:
    """Return the model fitted to training data of a window and a timing."""
    perceptron, errors = fit(data, hidden=hidden)
    return Anticipation(
        perceptron=perceptron,
        window=window,
        leads=np.array(LEADS),
        latency=timing.latency,
        provenance={
            **provenance,
            "control_period_s": timing.control_period,
            "samples": len(data.inputs),
            "library": f"scikit-learn {version('scikit-learn')}",
            "rms_error_mm": [round(1000 * e, 3) for e in errors[: len(LEADS)].tolist()],
        },
    )


def window_for(timing: Timing) -> FeatureWindow:
    """Return the window for a timing: as many values as at the paper's, or 1.2 s."""
    period = timing.control_period
    return FeatureWindow(
        interval=period, velocities=max(FeatureWindow.velocities, round(1.2 / period))
    )
