"""The programs and stand-ins that a virtual aircraft is flown with."""
