"""A policy that is a network in an ONNX file, run by onnxruntime on one processor.

One thread, operators in the order of the file, no rewriting of the graph: the same bits each time.
"""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..agent import Observation
from ..errors import InputError
from .libraries import import_library
from .network import Network, read_network
from .sizes import check_sizes

onnxruntime = import_library("onnxruntime")


class OnnxPolicy:
    """A network from the observation, and the state if there is one, to the action and a new state.

    Parameters
    ----------
    model
        The file, in the working directory.

    Raises
    ------
    InputError
        As :func:`.read_network` and :func:`.check_sizes`, or if onnxruntime refuses it.
    """

    def __init__(self, model: str = "policy.onnx") -> None:
        network = read_network(Path(model), model)
        check_sizes(network)
        self._network = network
        self._session = _session(network)
        self._state: NDArray[Any] | None = None

    def reset(self, seed: int) -> None:
        """Begin a lift: the state is zero."""
        state = self._network.state
        self._state = None if state is None else np.zeros(state.shape, state.dtype)

    def act(self, observation: Observation) -> float:
        """Return the change of the hands' height [m], and keep the new state.

        The network sees as many of the observation's first numbers as it takes: observations of
        other tasks begin with the five of a level table.

        Raises
        ------
        InputError
            If the task observes fewer numbers than the network takes.
        """
        seen, state = self._network.observation, self._network.state
        size = seen.shape[-1]
        if len(observation) < size:
            raise InputError(
                f"{self._network.name} takes an observation of {size} numbers, and this task's has "
                f"{len(observation)}: evaluate it on a suite of the task for which it was trained"
            )
        first: NDArray[Any] = np.asarray(observation[:size], seen.dtype)
        fed: dict[str, Any] = {seen.name: first.reshape(seen.shape)}
        if state is not None:
            fed[state.name] = self._state
        action, *after = self._session.run(self._network.outputs, fed)
        self._state = after[0] if after else None
        return float(action.item())


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
        reason = " ".join(str(error).split())
        raise InputError(f"{network.name} cannot be run by onnxruntime: {reason[:200]}") from error
