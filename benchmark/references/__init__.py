"""References beside policies: one that knows the future, and the best known, which is trained."""
