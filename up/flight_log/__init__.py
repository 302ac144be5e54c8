"""The flight log: an MCAP file of every Command, its writer, its reader and what it tells."""
