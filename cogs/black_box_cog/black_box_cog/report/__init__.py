"""The report of a flight: one page that explains it."""
