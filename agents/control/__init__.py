"""Parts that several policies share: predictors, feature windows, controllers."""
