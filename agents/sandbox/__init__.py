"""Sandboxes for untrusted policies: each episode runs in a new process with few rights."""
