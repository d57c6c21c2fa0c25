"""The leaderboard: boards, and how a submission becomes a row."""
