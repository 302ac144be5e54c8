"""The Ground Station Proxy: a relay between aircraft and ground stations on a public host."""
