"""The modules of the cog."""
