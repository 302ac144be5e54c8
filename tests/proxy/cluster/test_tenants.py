"""Two tenants on one NATS server, told apart by the accounts of their credentials, over TLS."""

import pytest

from tests.proxy.cluster.nodes import burst, refusal, relayed
from tests.proxy.program import Program, accepted
from tests.support.certificates import Certificates
from tests.support.nats_servers import NatsServers
from tests.support.scrape import probe
from tests.support.waiting import until

ACCOUNTS = """
accounts {{
  A {{ jetstream: enabled, users: [ {{ user: a, password: one }} ] }}
  B {{ jetstream: enabled, users: [ {{ user: b, password: two }} ] }}
}}
tls {{
  cert_file: "{folder}/certificate.pem", key_file: "{folder}/key.pem", ca_file: "{folder}/ca.pem"
  verify: true, handshake_first: true
}}
"""


@pytest.fixture(scope="module")
def certificates(tmp_path_factory):
    return Certificates(tmp_path_factory.mktemp("tls"))


@pytest.fixture(scope="module")
def server(tmp_path_factory, certificates):
    more = ACCOUNTS.format(folder=certificates.server("nats"))
    with NatsServers(tmp_path_factory.mktemp("nats"), 1, more) as running:
        yield running


def program(server, folder, credentials, tls):
    folder.mkdir()
    (folder / "nats.txt").write_text(credentials)
    (folder / "nats.txt").chmod(0o600)
    return Program(
        folder,
        f"cluster:\n  servers: {server.urls}\n  replicas: 1\n  credentials: nats.txt\n"
        f"  tls: {tls}\n",
    )


def test_a_tenant_sees_nothing_of_another(server, tmp_path, certificates):
    tls = certificates.client("node")
    with (
        program(server, tmp_path / "a1", "a:one", tls) as a1,
        program(server, tmp_path / "a2", "a:one", tls) as a2,
        program(server, tmp_path / "b1", "b:two", tls) as b1,
    ):
        until(lambda: all("cluster_ready" in each.codes() for each in (a1, a2, b1)), "the nodes")
        hello = "UP1 aircraft=same packed=1\n"
        of_a, _ = accepted(a1.airborne_port, hello)
        assert refusal(a2.airborne_port, hello) == "taken"
        of_b, _ = accepted(b1.airborne_port, hello)
        ground_hello = "UP1 aircraft=same seat=command packed=1\n"
        ground_a, _ = accepted(a2.ground_port, ground_hello)
        ground_b, _ = accepted(b1.ground_port, ground_hello)
        with of_a, of_b, ground_a, ground_b:
            ground_a.expect("seat command")
            ground_b.expect("seat command")
            of_a.say('{"down": "of a"}\n')
            relayed(of_b, ground_b, "of b")
            relayed(of_a, ground_a, "also of a")
            burst([(of_a, ground_a)])


@pytest.mark.parametrize(
    ("credentials", "client", "code"),
    [("a:two", True, "nats_refused"), ("a:one", False, "tls_unknown_ca")],
)
def test_a_node_that_nats_refuses_serves_local_pairs_only(
    server, tmp_path, certificates, credentials, client, code
):
    tls = certificates.client("refused") if client else certificates.self_signed()
    with program(server, tmp_path / "node", credentials, tls) as node:
        until(lambda: code in node.codes(), lambda: node.log)
        assert refusal(node.airborne_port, "UP1 aircraft=a\n") == "cluster"
        assert probe(node.metrics_port, "ready") == (503, "cluster")
        assert probe(node.metrics_port, "live") == (200, "live")
