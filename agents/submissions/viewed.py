"""A network that was trained in the training view, as a policy."""

from colift.agents.agent import Observation
from colift.agents.onnx.policy import OnnxPolicy
from colift.agents.submissions.training_view import VIEWS, TrainingView
from colift.base.errors import InputError
from colift.base.near_names import did_you_mean


class ViewedNetwork:
    """A network in an ONNX file that sees and acts through a view.

    Parameters
    ----------
    model
        The file, in the working directory.
    view
        A name of :data:`.VIEWS`.

    Raises
    ------
    InputError
        As :class:`.OnnxPolicy`, if there is no such view, or the network is too small for it.
    """

    def __init__(self, model: str = "policy.onnx", view: str = "training") -> None:
        if view not in VIEWS:
            near = did_you_mean(view, VIEWS)
            raise InputError(f"no view {view!r}; {near}known: {', '.join(VIEWS)}")
        self._network = OnnxPolicy(model)
        try:
            self._view = TrainingView(self._network.size, pace=VIEWS[view])
        except InputError as error:
            raise InputError(f"{model} does not fit view = {view!r}: {error}") from error

    def reset(self, seed: int) -> None:
        """Begin a lift: all states are zero, and everything stood still."""
        self._network.reset(seed)
        self._view.reset()

    def act(self, observation: Observation) -> float:
        """Return the change of the hands' height [m], and keep the new states."""
        return self._view.change(self._network.act(self._view.seen(observation))).item()
