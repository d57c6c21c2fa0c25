"""Live lifts in a browser: the web process between people's pages and the rooms where they lift."""
