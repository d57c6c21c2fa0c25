"""Evaluation of a submission: public and hidden runs, budgets, failures."""
