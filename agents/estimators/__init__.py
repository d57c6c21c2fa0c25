"""Estimators: what a robot can tell of the human's motion, and how sure it is of it."""
