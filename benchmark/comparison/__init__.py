"""Policies set against each other on the same episodes: ranks, differences, a picture, a page."""
