"""The programs that a virtual aircraft is flown with."""
