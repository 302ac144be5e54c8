"""The modules of the serial cog."""
