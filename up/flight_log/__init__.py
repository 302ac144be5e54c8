"""The flight log: an MCAP file of every Command, its writer, its reader and its analysis."""
