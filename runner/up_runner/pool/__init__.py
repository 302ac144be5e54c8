"""Several runners as one: placement, leases, state that moves with an instance (docs/pool.md)."""
