"""The roles of a network's inputs and outputs, as a line for its author."""

from colift.agents.actions import action_limit
from colift.agents.onnx.network import read_network
from colift.agents.onnx.ports import Port, quoted
from colift.agents.onnx.signature import Signature
from colift.agents.submissions.submission import Submission
from colift.agents.submissions.training_view import PERIOD, VIEWS, TrainingView
from colift.agents.tasks.agree.observation import AgreeObservation


def bound_text(submission: Submission) -> str:
    """Return what the inputs and outputs of a submission's network are, and its batch.

    The file is parsed in this process: only after the network was made in a sandbox.

    Raises
    ------
    InputError
        As :func:`.read_network`.
    """
    manifest = submission.manifest
    network = read_network(submission.folder / manifest.model, manifest.model)
    signature = network.signature
    parts = [_seen(signature.observation, manifest.view), _done(signature, manifest.view)]
    parts[1:1] = [
        f"state {_port(each.before)}, then {quoted(each.after.name)}" for each in signature.states
    ]
    if network.batch:
        parts.append("batch of 1" + "".join(f" ({quoted(name)})" for name in network.batch if name))
    return "; ".join(parts)


def _port(port: Port) -> str:
    return f"{quoted(port.name)} {list(port.shape)}"


def _seen(observation: Port, view: str) -> str:
    text, size = f"observation {_port(observation)}", observation.shape[-1]
    if view:
        steps = TrainingView(size, pace=VIEWS[view]).steps
        return f"{text}, by view = '{view}' with {steps} steps of the human's motion"
    if size > len(AgreeObservation):
        text += (
            f", more numbers than the {len(AgreeObservation)} of colift's own tasks: a network of "
            "training_env needs view = 'training' in policy.toml"
        )
    return text


def _done(signature: Signature, view: str) -> str:
    text, largest = f"action {quoted(signature.action.name)}", action_limit(PERIOD)
    if not view:
        return f"{text} in metres, clipped at {largest:g} m per step"
    shown = TrainingView(signature.observation.shape[-1], pace=VIEWS[view])
    what = "beside the human's last pace" if VIEWS[view] else "of the hands"
    return f"{text} clipped to [-1, 1], for {shown.largest:g} m per step {what}"
