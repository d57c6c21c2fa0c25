"""Sessions: people with habits, who learn about their partner from lift to lift."""
