"""The Commands of the cog."""
