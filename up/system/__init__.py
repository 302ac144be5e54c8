"""What programs ask of the operating system: supervision, addresses, time."""
