"""The folder of a device: refused when faulty, read again when changed."""

import os

import pytest

from tests.support.certificates import Certificates
from up.tls.errors import TLSError
from up.tls.files import TLSFiles


def code_of(call):
    with pytest.raises(TLSError) as caught:
        call()
    return caught.value.code


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o620, 0o602])
def test_a_key_that_others_may_read_or_write_is_refused(tmp_path, mode):
    own = Certificates(tmp_path)
    for folder, make in ((own.server(), "server"), (own.client(), "client")):
        getattr(TLSFiles(folder), make)()
        (folder / "key.pem").chmod(mode)
        assert code_of(getattr(TLSFiles(folder), make)) == "tls_key_mode"


def test_missing_and_faulty_files_are_named(tmp_path):
    own = Certificates(tmp_path)
    own.server()
    folder = own.client()
    (folder / "key.pem").write_bytes((own.authority.folder / "relay" / "key.pem").read_bytes())
    assert code_of(TLSFiles(folder).client) == "tls_bad_file"
    (folder / "key.pem").unlink()
    assert code_of(TLSFiles(folder).client) == "tls_no_file"
    (folder / "certificate.pem").unlink()
    TLSFiles(folder).client()  # without an own certificate, for a relay that requires none
    (folder / "ca.pem").write_text("")
    assert code_of(TLSFiles(folder).client) == "tls_bad_file"
    assert code_of(TLSFiles(tmp_path / "none").client) == "tls_no_file"


def test_changed_files_make_a_new_context_and_faulty_ones_leave_the_old(tmp_path):
    own = Certificates(tmp_path)
    files = TLSFiles(own.server())
    first = files.server()
    assert files.server() is first
    own.client()
    own.authority.revoke("glider-1")
    second = files.server()
    assert second is not first
    (files.folder / "revoked.pem").write_text("half a file")
    os.utime(files.folder / "revoked.pem", (1, 1))
    assert files.server() is second


def test_a_list_names_the_serial_numbers_that_it_revokes(tmp_path):
    own = Certificates(tmp_path)
    files = TLSFiles(own.server())
    own.client()
    (serial,) = [each.serial for each in own.authority.issued() if each.name == "glider-1"]
    raw = serial.to_bytes((serial.bit_length() + 7) // 8, "big")
    assert files.revoked_among([raw, b""]) == set()
    own.authority.revoke("glider-1")
    assert files.revoked_among([raw, b""]) == {raw}
