"""The link to the ground station (thesis 4.2.3)."""
