"""The policy of a trained recurrent network, as trainers write it into a submission."""
