"""Learning of a task model, combined with adaptive control."""

import numpy as np

from ..agent import Action, Observation
from ..control.task import load_task
from ..control.task_controller import TaskController, TaskModelParameters


class TaskModel:
    """Plans by a model learned from demonstrations, adapts its impedance (Gribovskaya et al. 2011).

    E. Gribovskaya, A. Kheddar, A. Billard, "Motion learning and adaptive impedance for robot
    control during physical interaction with humans", ICRA 2011: most likely reference 12 of
    Thobbi, Gu and Sheng (2011), by its title and their account of it: "a task-model learning
    approach combined with an adaptive control system. After going through a two-step learning
    process, the robot can work collaboratively with the human while inferring his intent". Its text
    was not at hand. This follows that account and, for the model, the abstract of an earlier work
    of the group, where a Gaussian mixture of demonstrated lifts is reproduced by regression
    (P. Evrard, E. Gribovskaya, S. Calinon, A. Billard, A. Kheddar, "Teaching physical collaborative
    tasks: object-lifting case study with a humanoid", Humanoids 2009). The control law is ours.

    **Step one** learns, from demonstrations by human-human teams, a Gaussian mixture of how people
    move who lift together. Its regression infers the human's intent: the coming velocities of the
    human's end with their covariance, from the height and the velocities that were seen. They carry
    a sample of age L over the latency and the period T, to where the human's end is now, p0, and
    where it will be at the end of the period, p1.

    **Step two** learns in practice with simulated people how stiffly to hold to that plan in each
    situation i (component of the mixture), K_i, and what to feed forward for the arm: a time by
    which the command runs ahead of the plan, and an offset (:func:`.adapt`).

    In a lift the hand moves with the plan and takes up a share of its deviation d from it:

        change = p1 - p0 + kappa d,    d = p0 + offset - command,
        kappa = 1 / (1 + K),    K = c sum_i h_i K_i,    c = t^2 / (t^2 + lambda s^2),

    with p0 and p1 taken the lead later. The h_i are the responsibilities of the components, t is
    the tolerance (how far apart the ends were in the demonstrations), s^2 the variance of p1, and
    lambda how surprising the last samples were (:class:`.Surprise`). So the robot insists on its
    plan while the model is sure and right, and goes along with what it sees of the human where it
    is not.
    """

    def __init__(self, *, parameters: TaskModelParameters | None = None) -> None:
        parameters = parameters or TaskModelParameters()
        self._controller = TaskController(load_task(parameters.model), parameters)

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._controller.reset()

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        return np.array([self._controller.step(observation).change])

    def internals(self) -> dict[str, float]:
        """Return what the last action was based on.

        Prediction of the human's end at the end of the period [m], with its velocity [m/s] and
        standard deviation [m]; surprise lambda; confidence, the certainty c; stiffness K; role, the
        share of a deviation that the hand does not take up, K / (1 + K).
        """
        return self._controller.internals
