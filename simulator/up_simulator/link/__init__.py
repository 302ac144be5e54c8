"""The link between aircraft, phone and ground, and how it fails."""
