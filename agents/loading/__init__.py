"""Policies by name, module or file: how they are found, made and given parameters."""
