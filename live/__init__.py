"""Lifts by real people: the room in which they lift, and its web process."""
