"""Training of the shipped policies, and the data on which they are trained."""
