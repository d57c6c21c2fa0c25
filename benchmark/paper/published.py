"""The numbers of the paper (Thobbi, Gu, Sheng 2011), section IV."""

from typing import Final

WITHOUT_PREDICTION: Final = {"S1": 19.139, "S2": 23.567, "S3": 24.872, "S4": 20.085, "S5": 22.432}
"""Table I: average RMSE of each subject with the reactive controller alone [mm]."""

WITH_PREDICTION: Final = {"S1": 12.967, "S2": 16.591, "S3": 18.418, "S4": 15.391, "S5": 17.684}
"""Table I: average RMSE of each subject with the whole framework [mm]."""

HUMAN_TEAM: Final = 6.531
"""RMSE of the one human-human team [mm] (section V.A)."""

MEDIAN_ITERATIONS: Final = 36
"""Median number of iterations until Q-learning converged (section IV.A)."""

LONGEST_ITERATIONS: Final = 62
"""Iterations of the longest of the ten trials."""

TRIALS: Final = 10
"""Number of learning trials."""

FORGETTING: Final = 0.45
"""Forgetting factor that was found good (section IV.C)."""

FORGETTING_FACTORS: Final = (0.05, 0.25, 0.45, 0.65, 0.85, 0.95)
"""Forgetting factors to compare; the figure's are not all legible, these span its range."""
