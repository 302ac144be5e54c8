"""Opens a serial port by termios: raw, 8N1, no flow control, exclusive."""

import errno
import fcntl
import os
import struct
import termios

_IFLAG, _OFLAG, _CFLAG, _LFLAG, _ISPEED, _OSPEED, _CC = range(7)
_TERMIOS2 = struct.Struct("=4I20s2I")
_TCGETS2, _TCSETS2, _BOTHER, _SPEED_BITS = 0x802C542A, 0x402C542B, 0o10000, 0o2003610017
"""struct termios2 of Linux on x86 and ARM, its calls, and CBAUD with CIBAUD."""


class SerialPortError(OSError):
    """A serial port that cannot be used; its text is one sentence for the user, ``code`` a name."""

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text)
        self.code = code


def open_serial(path: str, baud: int) -> int:
    """Return a non-blocking descriptor of the port, set up; raises SerialPortError.

    Closing the port leaves DTR unchanged, so that reopening it does not reset a board in flight.
    Input that arrived before is discarded.
    """
    if not 0 < baud < 1 << 32:
        raise SerialPortError(f"{path} cannot run at {baud} baud", code="speed_unsupported")
    speed = getattr(termios, f"B{baud}", None)
    try:
        descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK | os.O_CLOEXEC)
    except (OSError, ValueError) as error:
        raise _not_opened(path, error) from None
    try:
        _set_up(descriptor, speed or termios.B38400)
        if speed is None:
            _set_unlisted_speed(descriptor, baud)
        _claim(descriptor, path)
        termios.tcflush(descriptor, termios.TCIFLUSH)
    except SerialPortError:
        os.close(descriptor)
        raise
    except (OSError, termios.error) as error:
        os.close(descriptor)
        code = error.args[0]
        why = "is not a serial port" if code == errno.ENOTTY else f"failed: {os.strerror(code)}"
        raise SerialPortError(f"{path} {why}", code="not_a_port") from None
    return descriptor


def close_serial(descriptor: int) -> None:
    """Close the port immediately and discard unsent bytes.

    Otherwise closing a port with unsent bytes may block the program for half a minute.
    """
    try:
        termios.tcflush(descriptor, termios.TCOFLUSH)
    except termios.error:
        pass  # An unplugged port has nothing to flush.
    finally:
        os.close(descriptor)


def _set_up(descriptor: int, speed: int) -> None:
    """Set HUPCL and all other options in one call, as the first operation on the port."""
    attributes = termios.tcgetattr(descriptor)
    attributes[_IFLAG] = termios.IGNBRK
    attributes[_OFLAG] = 0
    attributes[_LFLAG] = 0
    control = attributes[_CFLAG] | termios.CS8 | termios.CREAD | termios.CLOCAL
    control &= ~(termios.PARENB | termios.CSTOPB | termios.CRTSCTS | termios.HUPCL)
    attributes[_CFLAG] = control
    attributes[_ISPEED] = attributes[_OSPEED] = speed
    attributes[_CC][termios.VMIN] = 1
    attributes[_CC][termios.VTIME] = 0
    termios.tcsetattr(descriptor, termios.TCSANOW, attributes)


def _set_unlisted_speed(descriptor: int, baud: int) -> None:
    """Set a speed that termios has no name for; the driver takes the nearest that it can."""
    *flags, _, _ = _TERMIOS2.unpack(fcntl.ioctl(descriptor, _TCGETS2, bytes(_TERMIOS2.size)))
    flags[_CFLAG] = flags[_CFLAG] & ~_SPEED_BITS | _BOTHER
    fcntl.ioctl(descriptor, _TCSETS2, _TERMIOS2.pack(*flags, baud, baud))


def _claim(descriptor: int, path: str) -> None:
    """Exclude other programs: an advisory lock, and exclusive use for those that ignore it."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise SerialPortError(f"{path} is in use by another program", code="port_in_use") from None
    fcntl.ioctl(descriptor, termios.TIOCEXCL)


def _not_opened(path: str, error: OSError | ValueError) -> SerialPortError:
    number = error.errno if isinstance(error, OSError) else errno.EINVAL
    if number in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        return SerialPortError(f"{path} is missing: is the board plugged in?", "port_missing")
    if number == errno.EBUSY:
        return SerialPortError(f"{path} is in use by another program", "port_in_use")
    if number in (errno.EACCES, errno.EPERM):
        advice = "add this user to the group dialout and log in again"
        return SerialPortError(f"{path} may not be opened: {advice}", "permission_denied")
    text = f"{path} cannot be opened: {os.strerror(number or errno.EIO)}"
    return SerialPortError(text, "port_unusable")
