"""Commands, and the bus that carries them (thesis 4.1.4)."""
