"""A new submission from a class in a file, ``file.py:Class``, or from a network."""

import ast
from pathlib import Path
from typing import Final

from colift.agents.loading.parameters import merged, split
from colift.agents.loading.policy_files import classes
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.submissions import fields
from colift.agents.submissions.new import POLICY, write_files
from colift.agents.submissions.packages import needed
from colift.base.errors import InputError
from colift.base.near_names import did_you_mean

DESCRIPTION: Final = "A policy."
"""The description of a class without a docstring."""


def write_from(folder: Path, text: str) -> tuple[str, ...]:
    """Write a new submission with the policy of a file; return its files.

    Parameters
    ----------
    folder
        The folder to write, as for :func:`.write_template`.
    text
        ``file.py:Class``, with parameters after a comma if any; only this file is copied, as
        ``policy.py``, and it is not run. Or ``file.onnx``, a network; see
        :func:`.write_from_network`.

    Raises
    ------
    InputError
        If there is no such file or class, the parameters are not ``name=value`` or not those of the
        class, the network cannot run, or as :func:`.write_template`.
    """
    if text.endswith(".onnx") or ".onnx," in text:
        # Only this kind of submission needs the extra.
        from colift.agents.submissions.from_network import write_from_network

        return write_from_network(folder, text)
    origin, _, parameters = PolicySpec(text=text).parts
    file, colon, name = origin.rpartition(":")
    if not (colon and file.endswith(".py")):
        raise InputError(
            f"a policy to copy must be file.py:Class,parameters or file.onnx, got {text!r}"
        )
    path = Path(file)
    found = classes(path)
    if name not in found:
        near = did_you_mean(name, found)
        raise InputError(f"{path} has no class {name!r}; {near}it has {', '.join(found) or 'none'}")
    if parameters:
        _check_parameters(found[name], parameters)
    source = path.read_bytes()
    content = {
        "description": _description(found[name]),
        "entry_point": f"{Path(POLICY).stem}:{name}",
        "parameters": merged(parameters),
        "packages": list(needed(source)),
    }
    return write_files(folder, source, content)


def _check_parameters(policy: ast.ClassDef, text: str) -> None:
    """Refuse parameters that the class cannot have, as far as its source shows them."""
    known = _arguments(policy)
    if known is None or "parameters" in known:
        return  # The fields of an argument 'parameters' go by their own names.
    for name in split(text):
        if name.partition(".")[0] not in known:
            near = did_you_mean(name, known)
            has = ", ".join(known) or "none"
            raise InputError(f"{policy.name} has no parameter {name!r}; {near}it has {has}")


def _arguments(policy: ast.ClassDef) -> list[str] | None:
    """Return the names of the constructor's arguments; None if they come from elsewhere."""
    if policy.decorator_list or policy.keywords:
        return None
    methods = {each.name: each for each in policy.body if isinstance(each, ast.FunctionDef)}
    start = methods.get("__init__")
    if "__new__" in methods or (start is not None and start.decorator_list):
        return None
    if start is None:
        return None if policy.bases else []
    positional = [*start.args.posonlyargs, *start.args.args][1:]
    return [each.arg for each in (*positional, *start.args.kwonlyargs)]


def _description(policy: ast.ClassDef) -> str:
    """Return the first line of the class's docstring, or the description of one without."""
    line = (ast.get_docstring(policy) or "").partition("\n")[0]
    try:
        return fields.text(line)
    except InputError:
        return DESCRIPTION
