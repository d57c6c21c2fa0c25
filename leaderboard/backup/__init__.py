"""Backup of a board in one file, and its restoration."""
