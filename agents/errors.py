"""The one family of errors that a user's input can cause."""


class InputError(ValueError):
    """Something a user gave is wrong; the message names it, its value and what would be right."""
