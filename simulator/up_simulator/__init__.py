"""The virtual aircraft, phone and boards."""
