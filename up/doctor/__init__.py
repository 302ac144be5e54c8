"""``up doctor``: what of this machine could disturb a flight."""
