"""A client of NATS for a test that runs in the reactor."""

from tests.support.reactor import reactor, until
from up_cluster.nats_client import NatsClient


async def connected(servers):
    """Return a client that is connected; the test stops it."""
    client = NatsClient(reactor, servers.addresses(), name="test")
    client.start()
    await until(lambda: client.is_connected)
    return client
