"""The section `cluster:`."""

import pytest

from up_cluster.config import ClusterConfig, ClusterError, Server
from up_proxy.config import ProxyConfig
from up_proxy.listener import StartError
from up_proxy.proxy import Proxy


def test_the_servers():
    config = ClusterConfig(servers="nats://a:4223, tls://b.example, [::1]:5,10.0.0.1", tls="nats")
    assert config.addresses() == [
        Server("a", 4223),
        Server("b.example", 4222),
        Server("::1", 5),
        Server("10.0.0.1", 4222),
    ]
    assert list(config.problems()) == []


@pytest.mark.parametrize(
    "servers",
    ["nats://", "a:0", "a:70000", "a,,b", "http://a", "a b", "nats://u:secret@a", "a,tls://b"],
)
def test_wrong_servers(servers):
    ((name, text),) = ClusterConfig(servers=servers).problems()
    assert name == "servers" and "secret" not in text


@pytest.mark.parametrize("tenant", ["", "a.b", "a b", "*"])
def test_a_tenant_is_one_word_of_a_subject(tenant):
    assert [name for name, _ in ClusterConfig(tenant=tenant).problems()] == ["tenant"]


@pytest.mark.parametrize(
    ("mode", "text", "expected"),
    [
        (0o600, "a:b:c\n", {"user": "a", "pass": "b:c"}),
        (0o600, "secret", {"auth_token": "secret"}),
        (0o640, "a:b", "cluster_credentials"),
        (0o600, "a:b\nc", "cluster_credentials"),
        (0o600, "", "cluster_credentials"),
        (0o600, None, "no_file"),
    ],
)
def test_credentials(tmp_path, mode, text, expected):
    path = tmp_path / "nats.txt"
    if text is not None:
        path.write_text(text)
        path.chmod(mode)
    config = ClusterConfig(servers="a", credentials=path.name)
    if isinstance(expected, dict):
        assert config.login(tmp_path) == expected
        return
    with pytest.raises(ClusterError) as caught:
        config.login(tmp_path)
    assert caught.value.code == expected
    with pytest.raises(StartError) as stopped:
        Proxy(StillReactor(), ProxyConfig(cluster=config), tmp_path)
    assert (stopped.value.code, stopped.value.status) == (expected, 2)


class StillReactor:
    """A reactor of which the start uses the time only."""

    def seconds(self):
        return 0.0
