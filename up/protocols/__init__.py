"""Every byte of the wires: pure codecs, and transports that hold no meaning."""
