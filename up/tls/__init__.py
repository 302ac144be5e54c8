"""TLS between neighbours on the link: certificates, contexts, connections, errors.

Python's own ``ssl`` carries it; only making certificates (``authority``) needs another package.
"""
