"""Flight modes of Raspilot: every file here is loaded."""
