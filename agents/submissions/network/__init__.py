"""The policy of a trained network, as trainers write it into a submission."""
