"""A dedicated satellite receiver, for Up."""
