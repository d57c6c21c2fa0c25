"""The policy of a network that was learned from a data set, as trainers write it."""
