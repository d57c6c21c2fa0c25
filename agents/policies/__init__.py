"""Robot policies: from a robot's observations to movements of its hands."""
