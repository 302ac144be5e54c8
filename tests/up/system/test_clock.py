"""Timers that a jump of the wall clock does not move."""

import subprocess
import sys

PROGRAM = """
import time
jump_s = [0.0]
real = time.time
time.time = lambda: real() + jump_s[0]
import twisted.python.runtime
assert twisted.python.runtime.seconds() is not None
from twisted.internet import reactor
reactor.seconds = lambda: time.time()
{use}
called = []
reactor.callWhenRunning(lambda: jump_s.__setitem__(0, -86400.0))
reactor.callLater(0.2, lambda: (called.append(1), reactor.stop()))
import threading, os, signal
threading.Thread(target=lambda: (time.sleep({limit_s}), os.kill(os.getpid(), signal.SIGTERM)),
                 daemon=True).start()
reactor.run()
print("called" if called else "late")
"""


def outcome(use, limit_s):
    program = PROGRAM.format(use=use, limit_s=limit_s)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_a_wall_clock_set_back_by_a_day_delays_nothing():
    use = "from up.system.clock import use_monotonic_time; use_monotonic_time(reactor)"
    assert outcome(use, limit_s=30) == "called"


def test_without_it_the_timer_would_wait_a_day():
    assert outcome("", limit_s=2) == "late"
