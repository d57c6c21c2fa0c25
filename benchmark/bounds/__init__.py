"""What no policy can beat: one that knows the future, and one that learned all there is to see."""
