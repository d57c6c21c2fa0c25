"""The tasks that need coordination, for a robot: its senses, what it infers, its policies."""
