"""The guest's side: starts a restricted process for each episode, and serves the policy there."""
