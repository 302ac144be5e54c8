"""The link between aircraft, phone and ground, and its faults."""
