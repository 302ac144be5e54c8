"""The ground station in a browser: a server on the ground's own computer."""
