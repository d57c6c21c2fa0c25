"""Lifts of real people on disk, and as suites."""
