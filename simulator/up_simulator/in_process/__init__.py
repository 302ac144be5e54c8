"""The whole system in one process and in simulated time: daemon, links, phone, ground."""
