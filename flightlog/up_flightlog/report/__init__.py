"""The report of a flight: one HTML page."""
