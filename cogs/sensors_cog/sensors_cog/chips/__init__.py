"""The chips, each by its data sheet."""
