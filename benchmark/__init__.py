"""The benchmark: world, environment, episodes, suites, metrics and results."""
