"""Agents: whoever holds an end of the table. Humans, robot policies, and their one interface."""
