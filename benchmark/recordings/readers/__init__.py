"""Readers of motion files, one file for each format."""
