"""Frozen views of a board, one per page."""
