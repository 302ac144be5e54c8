"""The modules of the MSP cog."""
