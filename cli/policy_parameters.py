"""The parameters of a policy, as a person reads them in a terminal."""

import ast
import inspect
import itertools
import textwrap
from collections.abc import Iterator

from rich.console import RenderableType
from rich.padding import Padding
from rich.text import Text

from ..agents.policies.loading import PolicySpec
from ..agents.policies.parameters import parameters_of
from ..agents.policies.values import kind, write_value
from ..agents.registry import summary


def policy_parameters(text: str) -> Iterator[RenderableType]:
    """Yield what a policy is and what can be set of it: names, defaults, kinds, meanings.

    Raises
    ------
    InputError
        If there is no such policy.
    """
    policy = PolicySpec(text=text).load()
    yield Text(f"{summary(policy)}\n")
    known = parameters_of(policy)
    for name, parameter in known.items():
        setting = f"{name}={write_value(parameter.default)}"
        yield Text.assemble((f"  {setting}", "bold"), (f"  {kind(parameter.hint)}", "dim"))
        meaning = field_docstrings(parameter.owner).get(parameter.name)
        if meaning is not None:
            yield Padding(Text(meaning), (0, 0, 0, 6))
    if known:
        yield Text(f"\nThese are the defaults. To set one: colift run {text},{setting}")
    else:
        yield Text("It has no parameters.")


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
