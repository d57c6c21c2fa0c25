"""Replays: lifts of the public run, drawn from their traces."""
