"""``python -m colift``: the command line."""

from .cli.start import start

start()
