"""Sandboxes for other people's policies: each episode runs in a new process with few rights."""
