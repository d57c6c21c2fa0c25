"""The board: seasons, standings, tokens."""
