"""One episode: scenario, lift, trace, metrics and scores."""
