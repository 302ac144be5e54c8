"""The wire formats: pure codecs, and transports that do not interpret messages."""
