import json
import subprocess
import sys

import pytest


@pytest.fixture
def made(up):
    assert up("certificates", "init").status == 0
    assert up("certificates", "device", "relay", "--host", "relay.example", "--host", "::1")
    assert up("certificates", "device", "glider-1").status == 0
    return up


def listed(up):
    return {each["name"]: each for each in json.loads(up("certificates", "list", "--json").out)}


def test_a_ca_issues_servers_and_clients(made, tmp_path):
    found = listed(made)
    assert found["relay"]["hosts"] == ["relay.example", "::1"]
    assert found["glider-1"]["hosts"] == []
    folder = tmp_path / "certificates"
    secret = [folder / "ca-key.pem", folder / "relay/key.pem", folder / "glider-1/key.pem"]
    assert {each.stat().st_mode & 0o777 for each in secret} == {0o600}
    assert sorted(each.name for each in (folder / "relay").iterdir()) == [
        "ca.pem",
        "certificate.pem",
        "key.pem",
        "revoked.pem",
    ]


def test_a_device_is_revoked_everywhere_and_can_be_issued_again(made, tmp_path):
    folder = tmp_path / "certificates"
    assert made("certificates", "revoke", "glider-1").status == 0
    assert listed(made)["glider-1"]["revoked"]
    lists = {path.read_bytes() for path in folder.rglob("revoked.pem")}
    assert len(lists) == 1
    assert made("certificates", "device", "glider-1").status == 0
    assert made("certificates", "revoke", "glider-1").status == 0
    rows = json.loads(made("certificates", "list", "--json").out)
    assert [each["revoked"] for each in rows if each["name"] == "glider-1"] == [True, True]


def test_a_renewed_certificate_has_the_hosts_and_both_are_revoked(made, tmp_path):
    before = (tmp_path / "certificates/relay/certificate.pem").read_bytes()
    assert made("certificates", "renew", as_json=True).codes == ["nothing_to_renew"]
    assert made("certificates", "renew", "relay").status == 0
    assert (tmp_path / "certificates/relay/certificate.pem").read_bytes() != before
    rows = json.loads(made("certificates", "list", "--json").out)
    hosts = [each["hosts"] for each in rows if each["name"] == "relay"]
    assert hosts == [["relay.example", "::1"]] * 2
    assert made("certificates", "device", "short", "--days", "30").status == 0
    assert made("certificates", "renew", as_json=True).codes == ["renewed"]
    made("certificates", "revoke", "relay")
    rows = json.loads(made("certificates", "list", "--json").out)
    assert [each["revoked"] for each in rows if each["name"] == "relay"] == [True, True]


def test_a_mistake_gets_a_code(made):
    for words, code, status in (
        (("init",), "ca_exists", 1),
        (("device", "glider-1"), "device_exists", 1),
        (("device", "a/b"), "bad_name", 1),
        (("device", "issued"), "bad_name", 1),
        (("device", "x", "--host", "a b"), "bad_host", 1),
        (("device", "x", "--days", "0"), "usage", 2),
        (("revoke", "nobody"), "unknown_device", 1),
        (("renew", "nobody"), "unknown_device", 1),
        (("list", "--folder", "nowhere"), "no_ca", 1),
    ):
        outcome = made("certificates", *words, as_json=True)
        assert (outcome.problem["code"], outcome.status) == (code, status)


def test_a_ca_key_that_others_may_read_signs_nothing(made, tmp_path):
    (tmp_path / "certificates/ca-key.pem").chmod(0o640)
    outcome = made("certificates", "device", "x", as_json=True)
    assert (outcome.problem["code"], outcome.status) == ("tls_key_mode", 1)


def test_without_the_package_there_is_a_sentence(tmp_path):
    program = (
        "import sys; sys.modules['cryptography'] = None\n"
        "from up.cli.main import main; sys.exit(main(['certificates', 'init']))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env={"UP_LOG_FORMAT": "json", "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 1
    assert json.loads(done.stderr)["fields"]["code"] == "import_missing"
