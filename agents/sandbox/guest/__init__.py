"""The guest's side: a restricted process for each episode, and the server of the policy in it."""
