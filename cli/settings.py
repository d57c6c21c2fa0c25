"""Options of a command from the fields of a dataclass: each setting is stated once, where it is."""

import dataclasses
import inspect
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Final, Literal, get_args, get_origin, get_type_hints

import typer
from colift.agents.loading.description import field_docstrings

METAVARS: Final[Mapping[type, str]] = {int: "N", float: "X", str: "NAME"}
"""What stands for a value in a help text, by its type; a truth has a flag and no value."""


def with_settings(
    command: Callable[..., None],
    kind: type[Any],
    *names: str,
    **words: Mapping[str, str],
) -> Callable[..., None]:
    """Return a command that has an option for each of some fields, instead of ``settings``.

    Type and default are those of the field; the help is the first sentence of its docstring. An
    option with choices takes any text, which the dataclass checks; the help names all choices but
    the empty one.

    Parameters
    ----------
    command
        Its parameters are keywords, one of them ``settings``.
    kind, names
        The dataclass, and the fields that are options; the others keep their defaults.
    words
        ``metavar`` or ``help`` of options that have others, by their names.
    """
    types, texts = get_type_hints(kind), field_docstrings(kind)
    defaults = {each.name: each.default for each in dataclasses.fields(kind)}

    def parameter(name: str) -> inspect.Parameter:
        meaning = texts[name].partition(". ")[0].rstrip(".")
        form, metavar = types[name], METAVARS.get(types[name])
        if get_origin(form) is Literal:
            form, metavar = str, "|".join(filter(None, get_args(form)))
        given: dict[str, Any] = {"metavar": metavar, "help": f"{meaning}."}
        return inspect.Parameter(
            name,
            inspect.Parameter.KEYWORD_ONLY,
            default=defaults[name],
            annotation=Annotated[form, typer.Option(**given | dict(words.get(name, {})))],
        )

    def run(**given: Any) -> None:
        settings = kind(**{name: given.pop(name) for name in names})
        command(settings=settings, **given)

    parameters: list[inspect.Parameter] = []
    for each in inspect.signature(command, eval_str=True).parameters.values():
        if each.name == "settings":
            parameters += map(parameter, names)
        else:
            parameters.append(each)
    run.__doc__ = command.__doc__
    run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in parameters}
    return run
