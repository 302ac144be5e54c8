"""Finding, choosing and ordering the modules of an application (thesis 3.3.6, 4.1.3, 4.3.2)."""
