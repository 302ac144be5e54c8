"""Signals to the server's process."""

import signal
import urllib.request


def test_user_signals_end_nothing(server):
    for number in (signal.SIGUSR1, signal.SIGUSR2):
        server.process.send_signal(number)
    with urllib.request.urlopen(f"http://127.0.0.1:{server.port}/") as page:
        assert page.status == 200
