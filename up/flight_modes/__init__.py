"""Flight modes: what an aircraft does, independent of which computer moves its surfaces."""
