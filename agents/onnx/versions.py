"""The versions that a file declares: of its format, and of ONNX's operators."""

from typing import Any

from colift.agents.onnx.allowed import IR_VERSIONS, OPSETS, OWN_DOMAINS
from colift.base.errors import InputError


def check_versions(model: Any) -> None:
    """Check the versions, and leave one declaration in the model, that of ONNX's own operators.

    Its two names, ``""`` and ``ai.onnx``, become the first. Other domains are declared by exporters
    whether or not an operator is of them; operators of them are refused by name elsewhere.

    Raises
    ------
    InputError
        If a version is not allowed, or the domain has none or several.
    """
    if model.ir_version not in IR_VERSIONS:
        raise InputError(
            f"has the IR version {model.ir_version}; {_among(IR_VERSIONS)} can be run: set "
            f"model.ir_version = {IR_VERSIONS[-1]} before it is saved"
        )
    found = {each.version for each in model.opset_import if each.domain in OWN_DOMAINS}
    if not found:
        raise InputError(
            f"has no opset of ONNX's own operators; {_among(OPSETS)} can be run: export it again"
        )
    if len(found) > 1:
        shown = " and ".join(map(str, sorted(found)))
        raise InputError(f"has the opsets {shown} of ONNX's own operators; it must have one")
    [version] = found
    if version not in OPSETS:
        raise InputError(f"has the opset {version}; {_among(OPSETS)} can be run: export it again")
    declared = type(model.opset_import[0])(version=version)
    del model.opset_import[:]
    model.opset_import.append(declared)
    for node in model.graph.node:
        if node.domain in OWN_DOMAINS:
            node.domain = ""


def _among(versions: range) -> str:
    return f"{versions[0]} to {versions[-1]}"
