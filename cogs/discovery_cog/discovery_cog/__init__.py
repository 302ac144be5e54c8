"""Lets the airborne phone find the Raspberry Pi (thesis 3.3.3)."""
