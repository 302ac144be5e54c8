"""Real processes, and the virtual aircraft in real time."""
