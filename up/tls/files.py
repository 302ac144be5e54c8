"""The folder with a device's certificate, and the TLS contexts that it makes."""

import base64
import ssl
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from twisted.logger import Logger

from up.tls.errors import TLSError
from up.version import BUILT_S

CA, CERTIFICATE, KEY, REVOKED = "ca.pem", "certificate.pem", "key.pem", "revoked.pem"
_NO_CHECK_TIME = 0x200000
"""OpenSSL's X509_V_FLAG_NO_CHECK_TIME, which the module ssl does not name."""


class TLSFiles:
    """Makes contexts of ``ca.pem``, ``certificate.pem``, ``key.pem`` and ``revoked.pem``.

    The files are read again when one of them has changed, so a renewed certificate or a new list
    of revoked ones needs no restart. While the clock is earlier than the program (a Raspberry Pi
    without a clock chip, before it has the time), dates are not checked, only the CA; logged once.
    """

    log = Logger()

    def __init__(self, folder: Path, seconds: Callable[[], float] = time.time) -> None:
        self.folder = folder
        self._seconds = seconds
        self._made: tuple[object, ssl.SSLContext] | None = None
        self._is_clock_logged = False
        self._reported = ""

    def client(self) -> ssl.SSLContext:
        """Return a context that accepts only a server of the CA with the right name.

        It presents the own certificate, if the folder has one. Raises TLSError.
        """
        context = _context(ssl.PROTOCOL_TLS_CLIENT)
        self._load_ca(context)
        if (self.folder / CERTIFICATE).exists():
            self._load_certificate(context)
        if (self.folder / REVOKED).exists():
            self._load_revoked(context)
        return context

    def server(self, *, clients: bool = True) -> ssl.SSLContext:
        """Return the server's context; with ``clients`` each needs a certificate of the CA.

        Raises TLSError, but only if there was never a good context: later a faulty file is logged,
        and the files read before remain in force.
        """
        signature = (
            clients,
            self._is_clock_wrong(),
            *map(self._stamp, (CA, CERTIFICATE, KEY, REVOKED)),
        )
        if self._made is None or self._made[0] != signature:
            try:
                self._made = (signature, self._server(clients))
            except TLSError as fault:
                if self._made is None:
                    raise
                self._made = (signature, self._made[1])
                text = "{fault}; the files read before remain in force"
                self.log.error(text, fault=str(fault), code=fault.code)
        return self._made[1]

    def revoked_among(self, serials: Iterable[bytes]) -> set[bytes]:
        """Return those of the serial numbers that the list names.

        They are searched in the list's bytes: a long random one occurs there only as an entry.
        """
        try:
            lines = self._read(REVOKED).splitlines()
            der = base64.b64decode("".join(each for each in lines if not each.startswith("-")))
        except (TLSError, ValueError):
            return set()
        return {each for each in serials if each and each in der}

    def _server(self, clients: bool) -> ssl.SSLContext:
        context = _context(ssl.PROTOCOL_TLS_SERVER)
        # A resumed session would not check the certificate again; idle tickets cost memory.
        context.options |= ssl.OP_NO_TICKET
        context.num_tickets = 0
        self._load_certificate(context)
        if clients:
            context.verify_mode = ssl.CERT_REQUIRED
            self._load_ca(context)
            self._load_revoked(context)
        return context

    def _load_ca(self, context: ssl.SSLContext) -> None:
        self._load(context, CA)
        if self._is_clock_wrong():
            context.verify_flags |= ssl.VerifyFlags(_NO_CHECK_TIME)
            if not self._is_clock_logged:
                self._is_clock_logged = True
                text = "the clock is wrong: certificates are accepted by their CA, whatever dates"
                self.log.warn(text, code="tls_clock_wrong")

    def _load_revoked(self, context: ssl.SSLContext) -> None:
        self._load(context, REVOKED)
        context.verify_flags |= ssl.VERIFY_CRL_CHECK_LEAF

    def _load(self, context: ssl.SSLContext, name: str) -> None:
        self._read(name)
        try:
            context.load_verify_locations(self.folder / name)
        except ssl.SSLError:
            raise TLSError(f"{self.folder / name} is not a PEM file", "tls_bad_file") from None

    def _load_certificate(self, context: ssl.SSLContext) -> None:
        self._read(CERTIFICATE)
        key = self.folder / KEY
        self._read(KEY)
        if key.stat().st_mode & 0o077:
            text = f"{key}: other users may read or write this key; chmod 600 {key}"
            raise TLSError(text, "tls_key_mode")
        try:
            # Without a password OpenSSL would ask for one on the terminal.
            context.load_cert_chain(self.folder / CERTIFICATE, key, password="")
        except ssl.SSLError as error:
            text = f"{key} is not the key of {CERTIFICATE} ({error.reason or 'not a PEM file'})"
            raise TLSError(text, "tls_bad_file") from None

    def _read(self, name: str) -> str:
        path = self.folder / name
        try:
            return path.read_text("ascii", "replace")
        except OSError as error:
            text = f"cannot read {path}: {error.strerror} ('up certificates' makes it)"
            raise TLSError(text, "tls_no_file") from None

    def _stamp(self, name: str) -> tuple[int, int, int] | None:
        try:
            found = (self.folder / name).stat()
        except OSError:
            return None
        return found.st_mtime_ns, found.st_size, found.st_ino

    def _is_clock_wrong(self) -> bool:
        return self._seconds() < BUILT_S


def _context(protocol: ssl._SSLMethod) -> ssl.SSLContext:
    context = ssl.SSLContext(protocol)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    context.options |= ssl.OP_NO_RENEGOTIATION
    return context


def peer_name(connection: ssl.SSLSocket | ssl.SSLObject) -> str:
    """Return the common name in the peer's verified certificate; empty without one."""
    found = connection.getpeercert() or {}
    subject: tuple[tuple[tuple[str, str], ...], ...] = found.get("subject", ())  # type: ignore[assignment]
    return next((value for part in subject for key, value in part if key == "commonName"), "")


def peer_serial(connection: ssl.SSLSocket) -> bytes:
    """Return the serial number of the peer's certificate; empty without one."""
    found = str((connection.getpeercert() or {}).get("serialNumber", ""))
    return bytes.fromhex(found)
