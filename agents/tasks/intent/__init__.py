"""The task ``intent`` for a robot: what it infers, its policies."""
