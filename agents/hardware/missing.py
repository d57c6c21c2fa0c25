"""Import of packages that only the hardware needs."""

import importlib
from typing import Any

from colift.base.errors import InputError
from colift.base.extras import how_to_install


def import_optional(package: str) -> Any:
    """Return an imported package of the extra ``nao``.

    Raises
    ------
    InputError
        If it is not installed; the message has the command that installs it.
    """
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise InputError(
            f"{package} is not installed ({error}); install it with: {how_to_install('nao')}"
        ) from error
