"""A small private certificate authority in a folder."""

import datetime as dt
import re
from collections.abc import Iterable, Sequence
from ipaddress import ip_address
from pathlib import Path
from typing import Any

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from up.config.atomic_writer import write_atomically
from up.errors import UserError
from up.quick_dataclass import dataclass
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE
from up.tls.files import CA, CERTIFICATE, KEY, REVOKED

CA_KEY = "ca-key.pem"
ISSUED = "issued"
"""The subfolder with a copy of every certificate ever issued."""
CA_DAYS = 7300
_HOST = re.compile(r"(?:\*\.)?[A-Za-z0-9](?:[A-Za-z0-9.-]{0,251}[A-Za-z0-9])?", re.ASCII)
_BACKDATED = dt.timedelta(days=1)
"""For devices whose clock is slow."""


@dataclass(frozen=True, slots=True)
class Issued:
    """A certificate of the authority; without ``hosts`` it is a client's."""

    name: str
    serial: int
    not_after: dt.datetime
    hosts: tuple[str, ...]
    is_revoked: bool


class Authority:
    """Issues and revokes certificates, each for a device, in a folder of the device's name."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def create(self, name: str) -> None:
        """Make the authority; raises UserError if the folder has one."""
        if (self.folder / CA_KEY).exists():
            raise UserError(f"{self.folder} has a CA already", "ca_exists")
        self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        key = ec.generate_private_key(ec.SECP256R1())
        subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])
        builder = _builder(subject, subject, key.public_key(), key.public_key(), CA_DAYS)
        builder = builder.add_extension(x509.BasicConstraints(ca=True, path_length=0), True)
        builder = builder.add_extension(_usage(is_ca=True), True)
        self._write(CA_KEY, _key_pem(key), 0o600)
        self._write(CA, _pem(builder.sign(key, hashes.SHA256())))
        self._write_list(())

    def issue(self, name: str, hosts: Sequence[str], days: int) -> Path:
        """Make a key and a certificate; return the folder to copy to the device.

        ``hosts``: the names and addresses of a server; a device without one is a client. Raises
        UserError if the name has a certificate that is valid and not revoked.
        """
        if not AIRCRAFT_NAME.fullmatch(name) or name == ISSUED:
            raise UserError(f"the name of a device must be {AIRCRAFT_NAME_RULE}", "bad_name")
        if any(not each.is_revoked for each in self.issued() if each.name == name):
            text = f"{name} has a certificate; renew it, or revoke it before it is issued again"
            raise UserError(text, "device_exists")
        return self._issue(name, hosts, days)

    def renew(self, name: str, days: int) -> Path:
        """Make a new key and certificate for the same name and hosts.

        The one before stays valid until it expires or is revoked.
        """
        own = [each for each in self.issued() if each.name == name and not each.is_revoked]
        if not own:
            raise UserError(f"{name} has no certificate to renew", "unknown_device")
        return self._issue(name, max(own, key=lambda each: each.not_after).hosts, days)

    def revoke(self, name: str) -> int:
        """Revoke every certificate of a name; return how many. Every folder gets the new list."""
        own = [each for each in self.issued() if each.name == name and not each.is_revoked]
        if not own:
            raise UserError(f"{name} has no certificate to revoke", "unknown_device")
        now = _now()
        self._write_list(
            x509.RevokedCertificateBuilder().serial_number(each.serial).revocation_date(now).build()
            for each in own
        )
        return len(own)

    def issued(self) -> list[Issued]:
        """Return every certificate ever issued, by name and expiry."""
        crl = self._list()
        found = []
        for path in (self.folder / ISSUED).glob("*.pem"):
            certificate = x509.load_pem_x509_certificate(path.read_bytes())
            serial = certificate.serial_number
            is_revoked = crl.get_revoked_certificate_by_serial_number(serial) is not None
            name = path.name.rpartition("-")[0]
            found.append(
                Issued(name, serial, _not_after(certificate), _hosts(certificate), is_revoked)
            )
        return sorted(found, key=lambda each: (each.name, each.not_after))

    def _issue(self, name: str, hosts: Sequence[str], days: int) -> Path:
        ca = x509.load_pem_x509_certificate(self._read(CA))
        ca_key: Any = self._ca_key()
        key = ec.generate_private_key(ec.SECP256R1())
        subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])
        builder = _builder(subject, ca.subject, key.public_key(), ca_key.public_key(), days)
        builder = builder.add_extension(x509.BasicConstraints(ca=False, path_length=None), True)
        builder = builder.add_extension(_usage(is_ca=False), True)
        # Only one of both: a stolen client's certificate must not pass for the relay's.
        purpose = ExtendedKeyUsageOID.SERVER_AUTH if hosts else ExtendedKeyUsageOID.CLIENT_AUTH
        builder = builder.add_extension(x509.ExtendedKeyUsage([purpose]), False)
        if hosts:
            names = x509.SubjectAlternativeName(list(map(_general_name, hosts)))
            builder = builder.add_extension(names, False)
        certificate = builder.sign(ca_key, hashes.SHA256())
        (self.folder / ISSUED).mkdir(exist_ok=True)
        folder = self.folder / name
        folder.mkdir(mode=0o700, exist_ok=True)
        self._write(f"{ISSUED}/{name}-{certificate.serial_number:x}.pem", _pem(certificate))
        self._write(f"{name}/{KEY}", _key_pem(key), 0o600)
        self._write(f"{name}/{CERTIFICATE}", _pem(certificate))
        self._write(f"{name}/{CA}", _pem(ca))
        self._write(f"{name}/{REVOKED}", self._read(REVOKED))
        return folder

    def _write_list(self, more: Iterable[x509.RevokedCertificate]) -> None:
        ca = x509.load_pem_x509_certificate(self._read(CA))
        key: Any = self._ca_key()
        now = _now()
        builder = x509.CertificateRevocationListBuilder().issuer_name(ca.subject)
        builder = builder.last_update(now - _BACKDATED)
        builder = builder.next_update(now + dt.timedelta(days=CA_DAYS))
        before = self._list() if (self.folder / REVOKED).exists() else ()
        for entry in (*before, *more):
            builder = builder.add_revoked_certificate(entry)
        content = _pem(builder.sign(key, hashes.SHA256()))
        self._write(REVOKED, content)
        for certificate in self.folder.glob(f"*/{CERTIFICATE}"):
            write_atomically(certificate.with_name(REVOKED), content)

    def _list(self) -> x509.CertificateRevocationList:
        return x509.load_pem_x509_crl(self._read(REVOKED))

    def _ca_key(self) -> Any:
        path = self.folder / CA_KEY
        content = self._read(CA_KEY)
        if path.stat().st_mode & 0o077:
            text = f"{path}: other users may read or write this key; chmod 600 {path}"
            raise UserError(text, "tls_key_mode")
        return serialization.load_pem_private_key(content, None)

    def _read(self, name: str) -> bytes:
        try:
            return (self.folder / name).read_bytes()
        except FileNotFoundError:
            text = f"{self.folder} has no {name}: 'up certificates init' makes a CA"
            raise UserError(text, "no_ca") from None

    def _write(self, name: str, content: bytes, mode: int = 0o644) -> None:
        write_atomically(self.folder / name, content, mode)


def _builder(
    subject: x509.Name, issuer: x509.Name, key: Any, issuer_key: Any, days: int
) -> x509.CertificateBuilder:
    now = _now()
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key)
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - _BACKDATED)
        .not_valid_after(now + dt.timedelta(days=days))
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key), False)
        .add_extension(x509.AuthorityKeyIdentifier.from_issuer_public_key(issuer_key), False)
    )


def _usage(*, is_ca: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not is_ca,
        key_cert_sign=is_ca,
        crl_sign=is_ca,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        encipher_only=False,
        decipher_only=False,
    )


def _general_name(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ip_address(host))
    except ValueError:
        pass
    if not _HOST.fullmatch(host):
        raise UserError(f"{host!r} is neither a host name nor an address", "bad_host")
    return x509.DNSName(host)


def _hosts(certificate: x509.Certificate) -> tuple[str, ...]:
    try:
        found = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName)
    except x509.ExtensionNotFound:
        return ()
    return tuple(str(each.value) for each in found.value)


def _not_after(certificate: x509.Certificate) -> dt.datetime:
    # Debian 12's package has only the form without a time zone, new ones warn about it.
    if hasattr(certificate, "not_valid_after_utc"):
        return certificate.not_valid_after_utc
    return certificate.not_valid_after.replace(tzinfo=dt.UTC)


def _now() -> dt.datetime:
    return dt.datetime.now(dt.UTC).replace(microsecond=0)


def _pem(signed: x509.Certificate | x509.CertificateRevocationList) -> bytes:
    return signed.public_bytes(serialization.Encoding.PEM)


def _key_pem(key: ec.EllipticCurvePrivateKey) -> bytes:
    return key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
