"""The leaderboard: boards, and the way from a submission to a row."""
