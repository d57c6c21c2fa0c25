"""The task to steer a ball on the table to a target place while lifting."""
