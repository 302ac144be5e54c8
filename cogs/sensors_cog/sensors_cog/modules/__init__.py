"""The modules of the sensors cog."""
