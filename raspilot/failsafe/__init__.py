"""What the aircraft does by itself when something fails in flight."""
