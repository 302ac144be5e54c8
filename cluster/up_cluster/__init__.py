"""What the servers of a cluster share: a NATS client, its key-value store, leases."""
