"""Panic Mode under load, and the state of the system."""
