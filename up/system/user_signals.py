"""Signals that mean nothing to the programs and would end them."""

import signal


def ignore_user_signals() -> None:
    """Ignore SIGUSR1 and SIGUSR2, whose default ends a process.

    By a handler, not SIG_IGN, which programs that this one starts would inherit.
    """
    for number in (signal.SIGUSR1, signal.SIGUSR2):
        signal.signal(number, lambda *_: None)
