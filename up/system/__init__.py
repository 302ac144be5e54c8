"""Operating system services: supervision, addresses, time."""
