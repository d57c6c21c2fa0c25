"""Learning the task model: first from demonstrations, then by practice in the world."""

import dataclasses
import hashlib
from collections.abc import Callable, Sequence
from importlib.metadata import version
from typing import Any, Final

import numpy as np
from colift.agents.agent import RobotObservation
from colift.agents.control.adaptive_impedance import Gains, LearnedImpedance, Movement, adapt
from colift.agents.control.learned_task import LearnedTask, velocity_inputs
from colift.agents.estimators.gaussian_mixture import GaussianMixture
from colift.agents.policies.task_model import TaskModelController, TaskModelParameters
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.ranges import PRACTISING_PEOPLE
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.demonstrations import Demonstration
from colift.benchmark.training.scikit import import_sklearn, reproducible_fit
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

Array = NDArray[np.float64]

COMPONENTS: Final = 12
"""Gaussians of the mixture. Twice as many hardly lower the error on new people."""

PAST: Final = 4
"""Past velocities that the model uses, one per interval."""

COMING: Final = 3
"""Coming velocities that it predicts, over latency, period and the arm's lag."""

FIRST_STIFFNESS: Final = 1.0
"""Stiffness in every situation before fine-tuning: that of the table."""

TUNING_SEED: Final = PRACTISING_PEOPLE[0]
"""Seed of the first lift of fine-tuning, far from those of the suites and demonstrations."""

TUNING_LIFTS: Final = 200
"""Lifts of fine-tuning, each with another person; the last half counts."""

SEEN_AFTER: Final = round((CONTROL_PERIOD + LATENCY) / CONTROL_PERIOD)
"""Steps from a movement to the sample that shows its end."""


def windows(demonstration: Demonstration, interval: float) -> Array:
    """Return the leading person's motion in a lift, in the model's variables.

    There is a row for each sample that is followed by enough others: the seen height and the past
    velocities, as a robot sees them, then the true coming velocities; the first of them leads from
    the seen height to the next one. Before the first sample the person stood still.

    Returns
    -------
    array
        (n - COMING, 1 + PAST + COMING), the height [m] and velocities [m/s].
    """
    seen, true = demonstration["seen_human_m"], demonstration["human_m"]
    begun = np.concatenate((np.full(PAST, seen[0]), seen))
    inputs = velocity_inputs(sliding_window_view(begun, PAST + 1), interval)[:-COMING]
    heights = sliding_window_view(true, COMING + 1).copy()
    heights[:, 0] = seen[:-COMING]
    return np.concatenate((inputs, np.diff(heights) / interval), axis=1)


def learn_task(
    demonstrations: Sequence[Demonstration], *, components: int = COMPONENTS, seed: int = 0
) -> LearnedTask:
    """Fit the mixture to demonstrations: step one.

    The fit is scikit-learn's expectation maximisation on standardised variables, in one thread, so
    that the same demonstrations give the same bits.

    Parameters
    ----------
    demonstrations
        Lifts whose samples all have the same interval.
    components
        Gaussians of the mixture.
    seed
        Seed of the fit's start.

    Raises
    ------
    InputError
        If scikit-learn is not installed, the intervals differ, or there are too few samples.
    """
    sklearn_mixture = import_sklearn("mixture")
    gaps = [float(np.diff(each.times).mean()) for each in demonstrations]
    if max(gaps) - min(gaps) > 0.01 * min(gaps):
        raise InputError(
            f"demonstrations must have one interval, got {min(gaps):g} to {max(gaps):g} s"
        )
    interval = round(float(np.median(gaps)), 6)
    long = [each for each in demonstrations if len(each.times) > COMING]
    data = np.concatenate([np.empty((0, 1 + PAST + COMING)), *(windows(x, interval) for x in long)])
    if components < 1 or len(data) < 10 * components:
        raise InputError(
            f"{components} components need at least {max(10 * components, 10)} samples, "
            f"got {len(data)}"
        )
    scale = data.std(axis=0)
    fit = sklearn_mixture.GaussianMixture(components, random_state=seed, tol=1e-4, max_iter=1000)
    with reproducible_fit():
        fit.fit(data / scale)
    covariances = fit.covariances_ * np.outer(scale, scale)
    mixture = GaussianMixture(
        weights=fit.weights_ / fit.weights_.sum(),
        means=fit.means_ * scale,
        covariances=(covariances + covariances.transpose(0, 2, 1)) / 2,
    )
    apart = np.concatenate([each["human_m"] - each["partner_m"] for each in demonstrations])
    return LearnedTask(
        mixture=mixture,
        past=PAST,
        interval=interval,
        tolerance=float(np.sqrt(np.mean(apart**2))),
        impedance=LearnedImpedance(
            stiffness=np.full(components, FIRST_STIFFNESS), lead=0.0, offset=0.0
        ),
        provenance={
            "demonstrations": _about(demonstrations),
            "fit": {
                "library": f"scikit-learn {version('scikit-learn')}",
                "samples": len(data),
                "components": components,
                "seed": seed,
                "converged": bool(fit.converged_),
                "iterations": int(fit.n_iter_),
            },
        },
    )


def fine_tune(
    task: LearnedTask,
    lifts: int = TUNING_LIFTS,
    *,
    gains: Gains | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> LearnedTask:
    """Return the task with the impedance learned by lifting with simulated people: step two.

    Each lift has a new person with one of the suites' behaviours, on separate seeds. The impedance
    adapts in every step (:func:`.adapt`) by the height difference that the robot sees once its
    movement is over; the result is its mean over the second half of the lifts.

    Raises
    ------
    InputError
        If there is no lift.
    """
    if lifts < 1:
        raise InputError(f"practice must be at least 1 lift, got {lifts}")
    gains = gains or Gains()
    controller = TaskModelController(task, TaskModelParameters())
    learned: list[LearnedImpedance] = []
    for seed in range(TUNING_SEED, TUNING_SEED + lifts):
        _lift_together(controller, task.tolerance, gains, seed)
        learned.append(controller.impedance)
        progress(1)
    late = learned[lifts // 2 :]
    impedance = LearnedImpedance(
        stiffness=np.mean([each.stiffness for each in late], axis=0),
        lead=float(np.mean([each.lead for each in late])),
        offset=float(np.mean([each.offset for each in late])),
    )
    about = {"seed": TUNING_SEED, "lifts": lifts, "gains": dataclasses.asdict(gains)}
    return dataclasses.replace(
        task, impedance=impedance, provenance={**task.provenance, "practice": about}
    )


def _lift_together(
    controller: TaskModelController, tolerance: float, gains: Gains, seed: int
) -> None:
    """Adapt the controller's impedance in one lift."""
    lift = Lift(make_scenario(BEHAVIOURS[seed % len(BEHAVIOURS)], f"draw-{seed}"))
    lift.reset(seed)
    human = lift.scripted_human()
    controller.reset(seed)
    movements: list[Movement] = []
    while not lift.done:
        view = lift.partner_observation()
        if len(movements) >= SEEN_AFTER:
            error = float(view[RobotObservation.HUMAN_END] - view[RobotObservation.ROBOT_END])
            controller.impedance = adapt(
                controller.impedance, movements[-SEEN_AFTER], error, tolerance, gains
            )
        movements.append(controller.step(view))
        lift.step(human.act(lift.human_observation()), np.array([movements[-1].change]))
    lift.close()


def _about(demonstrations: Sequence[Demonstration]) -> dict[str, Any]:
    """Return the provenance of the demonstrations."""
    sha = hashlib.sha256()
    for each in demonstrations:
        sha.update(np.ascontiguousarray(each.series, "<f8").tobytes())
    names = sorted({each.behaviour for each in demonstrations})
    return {
        "lifts": len(demonstrations),
        "first": demonstrations[0].lift,
        "last": demonstrations[-1].lift,
        "behaviours": names,
        "sha256": sha.hexdigest(),
    }
