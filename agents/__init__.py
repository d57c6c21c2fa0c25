"""Agents, which hold the ends of the table: humans and robot policies, with one interface."""
