"""The tasks: rules, people and scores of each."""
