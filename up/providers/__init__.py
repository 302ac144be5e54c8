"""The providers: the system's readings, their sources and their ages (thesis 3.2.2)."""
