"""The task ``agree`` for a robot: its senses, what it infers, its policies."""
