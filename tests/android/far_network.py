"""A network namespace at the end of a link that delays, loses and goes dark: needs root."""

import fcntl
import heapq
import itertools
import os
import random
import select
import struct
import threading
import time

import pytest

from tests.proxy.namespace import must, run
from tests.support.tools import need_root, need_tool, unavailable

NAME = f"up-far-{os.getpid()}"
# One subnet per process, so that two test runs on one machine do not meet.
_SUBNET = f"10.{150 + os.getpid() // 250 % 50}.{os.getpid() % 250}"
HERE, THERE = f"{_SUBNET}.1", f"{_SUBNET}.2"
_SET_INTERFACE = 0x400454CA  # TUNSETIFF of linux/if_tun.h
_TUN_WITHOUT_HEAD = 0x1001
LONGEST_PACKET = 2048
IDLE_S = 0.05


class FarNetwork:
    """A namespace whose packets to us and back go through this object.

    ``delay_s`` is that of each way, ``loss`` the chance of each packet to be lost, ``is_dark``
    loses all. ``prefix`` begins a command that runs there; from there we are ``HERE``.
    """

    prefix = ("ip", "netns", "exec", NAME)

    def __init__(self, delay_s=0.0, loss=0.0, seed=1):
        self.delay_s = delay_s
        self.loss = loss
        self.is_dark = False
        self.passed = self.lost = 0
        self._random = random.Random(seed)
        self._ends = []
        self._is_ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        need_root()
        need_tool("ip", "iproute2")
        made = run("ip", "netns", "add", NAME)
        if made.returncode != 0:
            unavailable(f"no network namespace: {made.stderr.strip()}")
        try:
            near, far = f"upn{os.getpid() % 100000}", f"upf{os.getpid() % 100000}"
            self._ends = [_tunnel(near), _tunnel(far)]
            must("ip", "addr", "add", HERE, "peer", THERE, "dev", near)
            must("ip", "link", "set", near, "up")
            must("ip", "link", "set", far, "netns", NAME)
            must(*self.prefix, "ip", "addr", "add", THERE, "peer", HERE, "dev", far)
            must(*self.prefix, "ip", "link", "set", far, "up")
            must(*self.prefix, "ip", "link", "set", "lo", "up")
        except BaseException:
            self._close()
            raise
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._is_ended.set()
        self._thread.join()
        self._close()

    def _close(self):
        for each in self._ends:
            os.close(each)
        run("ip", "netns", "del", NAME)

    def _run(self):
        on_way = []
        order = itertools.count()
        other = dict(zip(self._ends, reversed(self._ends), strict=True))
        while not self._is_ended.is_set():
            now_s = time.monotonic()
            while on_way and on_way[0][0] <= now_s:
                _, _, target, packet = heapq.heappop(on_way)
                self._pass(target, packet)
            wait_s = min(IDLE_S, on_way[0][0] - now_s) if on_way else IDLE_S
            for end in select.select(self._ends, [], [], wait_s)[0]:
                packet = os.read(end, LONGEST_PACKET)
                due_s = time.monotonic() + self.delay_s
                heapq.heappush(on_way, (due_s, next(order), other[end], packet))

    def _pass(self, target, packet):
        if self.is_dark or self._random.random() < self.loss:
            self.lost += 1
            return
        try:
            os.write(target, packet)
        except OSError:
            # Its interface is not up yet, or already gone.
            self.lost += 1
            return
        self.passed += 1


def _tunnel(name):
    try:
        end = os.open("/dev/net/tun", os.O_RDWR)
        request = struct.pack("16sH22x", name.encode(), _TUN_WITHOUT_HEAD)
        fcntl.ioctl(end, _SET_INTERFACE, request)
    except OSError as error:
        # A container's matter, which no package mends.
        pytest.skip(f"no tunnel device: {error.strerror}")
    return end
