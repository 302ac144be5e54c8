"""Rules of protected messages, each removed for the duration of a test."""

from up.protocols import envelope, handshake


def yes(*_):
    return True


def no_mac(m):
    m.setattr(envelope, "is_authentic", yes)
    m.setattr(handshake, "is_authentic", yes)


def no_counter(m):
    m.setattr(envelope, "is_newer", yes)


def no_direction(m):
    """One key for both directions; the counters would still refuse it."""
    real = handshake.SessionKeys.stream
    m.setattr(handshake.SessionKeys, "stream", lambda k, _, number: real(k, b"one", number))
    no_counter(m)
