"""Playing a suite: units of work, executors, provenance, and the journal of a run."""
