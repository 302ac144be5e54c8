"""The faults and the summary of a flight."""
