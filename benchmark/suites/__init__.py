"""Suites of scenarios, public and hidden."""
