"""Pictures of a flight, drawn with matplotlib where it is installed."""
