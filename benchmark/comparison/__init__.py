"""Comparison of policies on the same episodes: ranks, differences, a picture, a page."""
