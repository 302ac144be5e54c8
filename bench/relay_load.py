"""Load for the relay benchmark, a separate process: pairs that send a line and echo it back.

Reads one JSON object from stdin: {"mode": "proxy" | "forward" | "direct", "send": port,
"echo": port, "pairs": n, "rate_hz": r, "seconds": s, "size": bytes}; prints one JSON object with
the round trips' percentiles in microseconds, and of `one way`, those from the sending end to the
echo, as medians over the seconds: one in which the machine is busy otherwise does not spoil them.
`proxy`: both ends dial the relay and say hello; with "nodes", a list of [send, echo], the pairs are
spread over them; `forward`: the relay dials our echo port; `direct`: no relay. With "tls", the path
of a folder of certificates, both legs are TLS. With "waits" it sleeps between events, for programs
that share its core.
"""

import itertools
import json
import math
import os
import select
import socket
import ssl
import statistics
import sys
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

from bench.timing import percentile
from up.tls.files import TLSFiles

WARM_UP_S = 1.0
MIN_TRIPS = 200
EXTRA_S = 10.0
"""A busy machine gets this much longer to complete the least number of round trips."""
SECOND_NS = 10**9
LOST_NS = 2 * SECOND_NS
"""A line without an answer for so long was lost, for example before its ground had control."""


_NOT_READY = (BlockingIOError, ssl.SSLWantReadError)


def dial(port: int, hello: str = "", tls: ssl.SSLContext | None = None) -> socket.socket:
    peer = socket.create_connection(("127.0.0.1", port))
    peer.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    if tls is not None:
        peer = tls.wrap_socket(peer, server_hostname="127.0.0.1")
    if hello:
        peer.sendall(hello.encode("ascii"))
        answer = peer.recv(4096)
        if not answer.startswith(b"UP1 ok"):
            raise RuntimeError(f"the proxy answered {answer!r}")
    return peer


def pairs(job: dict[str, Any]) -> list[tuple[socket.socket, socket.socket]]:
    """Return the sending and the echoing end of each pair."""
    found = []
    listener = None
    folder = Path(job["tls"]) if job.get("tls") else None
    client = None if folder is None else TLSFiles(folder / "client").client()
    server = None if folder is None else TLSFiles(folder / "relay").server(clients=False)
    if job["mode"] != "proxy":
        listener = socket.create_server(("127.0.0.1", job["echo"]), backlog=1024)
        print(json.dumps({"echo": listener.getsockname()[1]}), flush=True)
        if job["mode"] == "forward":
            job["send"] = json.loads(sys.stdin.readline())["send"]
        else:
            job["send"] = listener.getsockname()[1]
    prefix = job.get("prefix", "bench")
    nodes = itertools.cycle(job.get("nodes") or [(job["send"], job["echo"])])
    for number in range(job["pairs"]):
        to_send, to_echo = next(nodes)
        if listener is None:
            own, name = client, f"{prefix}-{number}"
            if folder is not None:
                own = TLSFiles(folder / name).client()
            echo = dial(to_echo, f"UP1 aircraft={name}\n", own)
            send = dial(to_send, f"UP1 aircraft={name} seat=command\n", client)
        else:
            send = dial(to_send, tls=client)
            echo, _ = listener.accept()
            echo.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            if server is not None:
                echo = server.wrap_socket(echo, server_side=True)
        found.append((send, echo))
    return found


def measure(
    job: dict[str, Any], ends: list[tuple[socket.socket, socket.socket]]
) -> tuple[list[int], list[list[int]]]:
    """Send at the requested rate, evenly spread over the pairs; return round trips, one way; ns.

    The latter in a list for each second. On a machine that is too busy for any there are none.
    """
    poll = select.epoll()
    echoes = {echo.fileno(): (echo, send.fileno()) for send, echo in ends}
    senders = {send.fileno(): send for send, _ in ends}
    for each in itertools.chain(*ends):
        each.setblocking(False)
        poll.register(each.fileno(), select.EPOLLIN)
    time.sleep(0.2)
    for send, _ in ends:  # the proxy's lines about seats
        while True:
            try:
                send.recv(65536)
            except _NOT_READY:
                break
    order = [send for send, _ in ends]
    line = b"x" * (job["size"] - 1) + b"\n"
    sent_ns = dict.fromkeys(senders, 0)
    trips: list[int] = []
    ways: defaultdict[int, list[int]] = defaultdict(list)
    step_ns = int(1e9 / (job["rate_hz"] * len(order)))
    begin_ns = time.perf_counter_ns()
    warm_ns = begin_ns + int(WARM_UP_S * 1e9)
    end_ns = warm_ns + int(job["seconds"] * 1e9)
    limit_ns = end_ns + int(EXTRA_S * 1e9)
    due_ns, turn, warm = begin_ns, 0, False
    clock = time.perf_counter_ns
    while True:
        now_ns = clock()
        if now_ns >= end_ns and (len(trips) >= MIN_TRIPS or now_ns >= limit_ns):
            return trips, list(ways.values())
        if not warm and now_ns >= warm_ns:
            warm = True
            print(json.dumps({"warm": True}), flush=True)
        if now_ns >= due_ns:
            peer = order[turn]
            turn = (turn + 1) % len(order)
            due_ns += step_ns
            if now_ns - sent_ns[peer.fileno()] > LOST_NS:
                sent_ns[peer.fileno()] = clock()
                peer.send(line)
        if job.get("waits"):  # epoll's own timeout is in milliseconds
            select.select((poll,), (), (), max(0, due_ns - clock()) / 1e9)
        for descriptor, _ in poll.poll(0):
            echo = echoes.get(descriptor)
            try:
                if echo is not None:
                    end, sender = echo
                    data = end.recv(65536)
                    if sent_ns[sender] > warm_ns:
                        now_ns = clock()
                        ways[(now_ns - warm_ns) // SECOND_NS].append(now_ns - sent_ns[sender])
                    end.send(data)
                    continue
                answer = senders[descriptor].recv(65536)
            except _NOT_READY:
                continue
            if answer.endswith(b"x\n"):
                if sent_ns[descriptor] > warm_ns:
                    trips.append(clock() - sent_ns[descriptor])
                sent_ns[descriptor] = 0


def of_seconds(ways: list[list[int]], share: float) -> float:
    """Return the median of the seconds' percentiles."""
    found = [percentile(sorted(each), share) for each in ways]
    return statistics.median(found) if found else math.nan


def main() -> None:
    job = json.loads(sys.stdin.readline())
    if "cpu" in job:
        os.sched_setaffinity(0, {job["cpu"]})
    ends = pairs(job)
    print(json.dumps({"ready": True}), flush=True)
    trips, ways = measure(job, ends)
    trips.sort()
    print(json.dumps({"done": True}), flush=True)
    sys.stdin.readline()  # the connections stay until the relay's CPU time is read
    figures = {
        "count": len(trips),
        "p50_us": percentile(trips, 0.5) / 1e3,
        "p99_us": percentile(trips, 0.99) / 1e3,
        "longest_us": percentile(trips, 1.0) / 1e3,
        "one_way_p50_us": of_seconds(ways, 0.5) / 1e3,
        "one_way_p99_us": of_seconds(ways, 0.99) / 1e3,
    }
    print(json.dumps(figures), flush=True)


if __name__ == "__main__":
    main()
