"""Pictures of flights, drawn with matplotlib where it is installed."""
