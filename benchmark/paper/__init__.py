"""The paper, reproduced: its table, its figures and its claims, side by side with ours."""
