"""The policy of a trained network that remembers a session, as trainers write it."""
