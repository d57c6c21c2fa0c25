"""Robots that can hold the far end of the table: one declaration each, an entry point."""
