"""Automatic actions when something fails in flight."""
