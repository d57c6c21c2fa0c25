"""The policy of a recurrent network of sight and touch, as trainers write it into a submission."""
