"""A private CA with devices, good ones and bad ones, for tests of TLS."""

import datetime as dt
from unittest import mock

from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.serialization import Encoding, load_pem_private_key

from up.tls import authority
from up.tls.authority import Authority

SERVER = "127.0.0.1"


class Certificates:
    """Folders as `up certificates` makes them; each is the path of a folder."""

    def __init__(self, folder):
        self.authority = Authority(folder / "ca")
        self.authority.create("test")
        self.other = Authority(folder / "other")

    def server(self, name="relay", hosts=(SERVER,), days=10):
        return self.authority.issue(name, hosts, days)

    def client(self, name="glider-1", days=10):
        return self.authority.issue(name, (), days)

    def of_another_ca(self, name, hosts=()):
        """Return a device that trusts our CA, with a certificate of another one of that name."""
        if not self.other.folder.exists():
            self.other.create("test")
        made = self.other.issue(name, hosts, 10)
        (made / "ca.pem").write_bytes((self.authority.folder / "ca.pem").read_bytes())
        (made / "revoked.pem").unlink()
        return made

    def old_list(self):
        """Return the text of an empty list of revoked certificates that has expired."""
        ca = x509.load_pem_x509_certificate((self.authority.folder / "ca.pem").read_bytes())
        key = load_pem_private_key((self.authority.folder / "ca-key.pem").read_bytes(), None)
        now = dt.datetime.now(dt.UTC)
        old = x509.CertificateRevocationListBuilder().issuer_name(ca.subject)
        old = old.last_update(now - dt.timedelta(2)).next_update(now - dt.timedelta(1))
        return old.sign(key, hashes.SHA256()).public_bytes(Encoding.PEM)

    def self_signed(self):
        """Return a device whose certificate is that of a CA of its own."""
        made = self.of_another_ca("self")
        (made / "certificate.pem").write_bytes((self.other.folder / "ca.pem").read_bytes())
        (made / "key.pem").write_bytes((self.other.folder / "ca-key.pem").read_bytes())
        return made

    def of_tomorrow(self, name, hosts=()):
        """Return a device whose certificate is valid from the day after tomorrow."""
        later = dt.datetime.now(dt.UTC) + dt.timedelta(days=3)
        with mock.patch.object(authority, "_now", lambda: later):
            return self.authority.issue(name, hosts, 10)
