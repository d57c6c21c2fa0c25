"""Isolation: policies of strangers, each episode in a fresh sandboxed process."""
