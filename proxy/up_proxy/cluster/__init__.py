"""The proxy as a node of a cluster; imported only with `cluster:` in proxy.yml."""
