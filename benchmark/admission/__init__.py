"""The admission of a suite: measures of whether its lifts need coordination."""
