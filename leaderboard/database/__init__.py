"""The tables of a board, in SQLite or PostgreSQL, and how they come to be."""
