"""Descriptions of a policy's parameters: names, defaults, kinds, meanings."""

import ast
import inspect
import itertools
import textwrap
from dataclasses import dataclass

from colift.agents.loading.parameters import parameters_of
from colift.agents.loading.values import kind, write_value
from colift.base.docstrings import plain_text


@dataclass(frozen=True, kw_only=True)
class ParameterText:
    """The description of one parameter of a policy."""

    name: str
    default: str
    """Its default, as a user writes it."""
    kind: str
    """The kind of its values, such as ``a number``."""
    meaning: str
    """The docstring under its field, on one line; empty if there is none."""


def described(policy: type) -> tuple[ParameterText, ...]:
    """Return the descriptions of a policy's parameters.

    Raises
    ------
    InputError
        As :func:`.parameters_of`.
    """
    return tuple(
        ParameterText(
            name=name,
            default=write_value(parameter.default),
            kind=kind(parameter.hint),
            meaning=plain_text(field_docstrings(parameter.owner).get(parameter.name, "")),
        )
        for name, parameter in parameters_of(policy).items()
    )


def field_docstrings(owner: type) -> dict[str, str]:
    """Return the docstrings under the fields of a class, each on one line."""
    found: dict[str, str] = {}
    for base in reversed(owner.__mro__):
        try:
            (tree,) = ast.parse(textwrap.dedent(inspect.getsource(base))).body
        except (OSError, TypeError):
            continue
        for field, below in itertools.pairwise(tree.body if isinstance(tree, ast.ClassDef) else ()):
            match field, below:
                case (
                    ast.AnnAssign(target=ast.Name(id=str(name))),
                    ast.Expr(value=ast.Constant(value=str(docstring))),
                ):
                    found[name] = " ".join(docstring.split())
    return found
