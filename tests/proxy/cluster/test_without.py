"""Without `cluster:` a proxy loads nothing of it."""

import subprocess
import sys

PROGRAM = """
import sys
from twisted.internet import reactor
from up_proxy.config import ProxyConfig
from up_proxy.proxy import Proxy
proxy = Proxy(reactor, ProxyConfig(airborne_port=0, ground_port=0, metrics_port=0))
proxy.start()
proxy.stop()
names = ("up_cluster.", "up_proxy.cluster")
print(*(name for name in sys.modules if name.startswith(names)))
"""


def test_only_its_section_of_the_configuration_is_loaded():
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["up_cluster.config"]
