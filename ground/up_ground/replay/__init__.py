"""Flights of the past, shown by the page as if they were of now."""
