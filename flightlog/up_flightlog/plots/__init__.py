"""Pictures of a flight, drawn with matplotlib if it is installed."""
