"""The task to bring the table to the pose that the human intends."""
