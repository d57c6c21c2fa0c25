"""The host's side: isolation levels, the start of sandboxes, and checks of their answers."""
