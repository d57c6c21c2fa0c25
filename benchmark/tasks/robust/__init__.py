"""The suite of one policy for all: unknown conditions, and people with habits of their own."""
