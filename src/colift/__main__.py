"""``python -m colift``: the command line."""

from .cli.main import main

main()
