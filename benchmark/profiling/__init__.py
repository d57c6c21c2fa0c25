"""Measurements of the benchmark itself: speed, convergence, sandboxes, clusters."""
