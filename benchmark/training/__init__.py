"""Training of the shipped policies, and the data they are trained on."""
