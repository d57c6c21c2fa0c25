"""The admission of a suite: whether its lifts need coordination, by figures."""
