"""Database of a board in SQLite or PostgreSQL: schema, migrations and queries."""
