"""The airborne phone (thesis 3.3.3, 4.2.3)."""
