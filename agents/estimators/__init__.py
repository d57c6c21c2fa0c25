"""Estimators of the human's motion, with their uncertainty."""
