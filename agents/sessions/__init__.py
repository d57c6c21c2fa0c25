"""Policies that get to know a person in the lifts of a session."""
