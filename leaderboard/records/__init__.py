"""Records of a board: rows, entries, events, jobs and seasons."""
