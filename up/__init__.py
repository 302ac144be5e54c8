"""Up: a modular framework for autopilots that can be changed."""
