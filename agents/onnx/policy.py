"""A policy that is a network in an ONNX file, run by onnxruntime on one processor.

One thread, operators in the order of the file, no rewriting of the graph: the same bits each time.
"""

from pathlib import Path
from typing import Any

import numpy as np
from colift.agents.onnx.libraries import import_library
from colift.agents.onnx.network import Network, read_network
from colift.agents.onnx.ports import one_line
from colift.base.errors import InputError
from numpy.typing import NDArray

onnxruntime = import_library("onnxruntime")


class OnnxPolicy:
    """A network from the observation, and its states if any, to the action and new states.

    Everything is loaded, and a first step has been computed, when it is made: a step opens no file
    and starts no thread.

    Parameters
    ----------
    model
        The file, in the working directory.

    Raises
    ------
    InputError
        As :func:`.read_network`, or if onnxruntime refuses it.
    """

    def __init__(self, model: str = "policy.onnx") -> None:
        self._network = read_network(Path(model), model)
        signature = self._network.signature
        self._seen, self._states = signature.observation, signature.states
        self._outputs = [each.name for each in (signature.action, *(s.after for s in self._states))]
        self.size = self._seen.shape[-1]
        """Numbers that the network observes."""
        self._session = _session(self._network)
        self.reset(0)
        self._try()

    def reset(self, seed: int) -> None:
        """Begin a lift: all states are zero."""
        self._now: dict[str, NDArray[Any]] = {
            each.before.name: np.zeros(each.before.shape, each.before.dtype)
            for each in self._states
        }

    def act(self, observation: NDArray[np.floating[Any]]) -> float:
        """Return the change of the hands' height [m], and keep the new states.

        The network sees as many of the observation's first numbers as it takes: observations of
        other tasks begin with the five of a level table.

        Raises
        ------
        InputError
            If the task observes fewer numbers than the network takes.
        """
        if len(observation) < self.size:
            raise InputError(
                f"{self._network.name} takes an observation of {self.size} numbers, and this "
                f"task's has {len(observation)}: evaluate it on a suite of the task for which it "
                "was trained; if that was in training_env, policy.toml needs view = 'training'"
            )
        return self._step(np.asarray(observation[: self.size], self._seen.dtype))

    def _step(self, seen: NDArray[Any]) -> float:
        fed = {self._seen.name: seen.reshape(self._seen.shape), **self._now}
        action, *after = self._session.run(self._outputs, fed)
        self._now = {each.before.name: new for each, new in zip(self._states, after, strict=True)}
        return float(action.item())

    def _try(self) -> None:
        """Compute a step from zeros, and begin anew; raise InputError if that fails."""
        try:
            self._step(np.zeros(self.size, self._seen.dtype))
        except Exception as error:  # onnxruntime's errors have no common base class.
            raise _refused(self._network, error) from error
        self.reset(0)


def _session(network: Network) -> Any:
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.execution_mode = onnxruntime.ExecutionMode.ORT_SEQUENTIAL
    options.graph_optimization_level = onnxruntime.GraphOptimizationLevel.ORT_DISABLE_ALL
    options.use_deterministic_compute = True
    options.enable_cpu_mem_arena = options.enable_mem_pattern = False
    options.log_severity_level = 4  # Errors are raised instead.
    try:
        return onnxruntime.InferenceSession(
            network.model.SerializeToString(), options, providers=["CPUExecutionProvider"]
        )
    except Exception as error:  # onnxruntime's errors have no common base class.
        raise _refused(network, error) from error


def _refused(network: Network, error: Exception) -> InputError:
    reason = " ".join(str(error).split())
    return InputError(f"{network.name} cannot be run by onnxruntime: {one_line(reason, 200)}")
