"""The serial line between Raspberry Pi and Arduino (thesis 3.1.2)."""
