"""The modules of the Arduino cog."""
