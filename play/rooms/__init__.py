"""Lifts by real people, frame by frame: hands, rooms, and the proof of what happened."""
