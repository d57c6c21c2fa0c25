"""``python -m colift``: the command line."""

from colift.cli.start import start

start()
