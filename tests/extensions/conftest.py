"""Extensions are tried by the command line in this process."""

from ..cli.conftest import colift

__all__ = ["colift"]
