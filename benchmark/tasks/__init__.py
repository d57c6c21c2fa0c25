"""Tasks in which a level table is not enough."""
