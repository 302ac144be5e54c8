"""Recorded flights, shown by the page like live ones."""
