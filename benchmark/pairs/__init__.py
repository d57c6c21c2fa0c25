"""Pairs of people who were recorded at both ends of a table, beside the simulated two people."""
