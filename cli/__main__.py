"""``python -m colift.cli``."""

from .start import start

start()
