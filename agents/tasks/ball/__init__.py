"""The task ``ball`` for a robot: its senses, what it infers, its policies."""
