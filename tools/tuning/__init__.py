"""The tuning aid: step responses, margins and gains from flights in the simulator or their logs."""
