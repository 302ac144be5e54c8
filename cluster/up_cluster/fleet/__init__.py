"""The program `up-fleet`: the proxies and runners of a cluster, listed and controlled."""
