"""Recorded flights in a browser: `up log view`."""
