"""Results of a run: baselines, summary and headline."""
