"""The airborne phone: a stub in Python."""
