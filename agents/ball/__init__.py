"""The ball on the table as a robot sees, feels and steers it."""
