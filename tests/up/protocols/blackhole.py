"""Run inside a separate network namespace: how long does a link take to notice a blackhole?

Argument: `sending` or `idle`. Prints the seconds and the reason.
"""

import socket
import subprocess
import sys

from twisted.internet import reactor
from twisted.internet.protocol import Factory

from up.protocols.general_message_link import GeneralMessageProtocol

RULES = (
    "add table inet hole",
    "add chain inet hole out { type filter hook output priority 0; }",
    "add rule inet hole out drop",
)


def on_connected(link: GeneralMessageProtocol) -> None:
    for rule in RULES:
        subprocess.run(["nft", *rule.split(" ")], check=True)
    global began
    began = reactor.seconds()
    if sys.argv[1] == "sending":
        link.send(b"{}\n")


def on_lost(link: GeneralMessageProtocol, why: str) -> None:
    print(f"{reactor.seconds() - began:.2f} {why}")
    reactor.stop()


def make() -> GeneralMessageProtocol:
    return GeneralMessageProtocol(
        reactor,
        on_message=lambda link, message: None,
        on_malformed=lambda link, fault: None,
        on_connected=on_connected,
        on_lost=on_lost,
    )


began = 0.0
subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
port = reactor.listenTCP(0, Factory.forProtocol(make), interface="127.0.0.1")
peer = socket.create_connection(("127.0.0.1", port.getHost().port))
reactor.callLater(60, reactor.stop)
reactor.run()
