"""The practice seasons that are distributed with colift, and their import."""
