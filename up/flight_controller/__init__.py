"""The abstract Flight Controller and its gains (thesis 3.2.3)."""
