"""The modules of the GPS cog."""
