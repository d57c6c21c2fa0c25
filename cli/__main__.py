"""``python -m colift.cli``."""

from .main import main

main()
