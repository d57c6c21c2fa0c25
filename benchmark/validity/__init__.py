"""Validity: how well suites predict the scores of policies with real people."""
