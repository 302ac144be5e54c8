"""The modules of the CRSF cog."""
