"""Export of lifts as data sets: Minari and LeRobot, each lift proved by its replay."""
