"""Discovery of the Raspberry Pi by the airborne phone (thesis 3.3.3)."""
