"""Hardware trials: the emulated laboratory, and a trial's scores, bundle and calibration."""
