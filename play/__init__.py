"""Lifts by real people, on a web page: the room in which they lift, and its web process."""
