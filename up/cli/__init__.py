"""The command ``up`` (thesis 4.3.2): creating, checking, starting applications and cogs."""
