"""The boards that a simulated flight can have aboard: the firmware itself, or none at all."""
