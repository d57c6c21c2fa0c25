"""``python -m colift.cli``."""

from colift.cli.start import start

start()
