"""Policies by name, module or file: their lookup, construction and parameters."""
