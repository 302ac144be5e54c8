"""The Commands of the Arduino cog."""
