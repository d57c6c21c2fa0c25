"""Recordings from the files of laboratories: read, chosen, checked, cut into lifts, written."""
