"""The providers: what the system knows, from whom, and how old it is (thesis 3.2.2)."""
