"""``up keys``: devices are added, shown, listed and revoked; secrets only where they are wanted."""

import json
import stat

import pytest

from up.config import ConfigErrors
from up.config.keys_file import KEYS
from up.protocols.pairing import parse_pairing


@pytest.fixture
def keys(up, tmp_path):
    up("create", "new", "-n", "plane")
    folder = tmp_path / "plane"
    (folder / "config").mkdir(exist_ok=True)

    def run(*words):
        return up("keys", *words, cwd=folder, as_json=True)

    run.folder = folder / "config"
    return run


def pairing_of(outcome):
    (found,) = filter(None, map(parse_pairing, outcome.out.splitlines()))
    return found


def test_a_new_key_is_valid_and_only_its_owner_reads_the_file(keys):
    made = pairing_of(keys("add", "--role", "pilot", "--name", "tablet", "--aircraft", "kite"))
    path = keys.folder / KEYS.filename
    ((key_id, key),) = KEYS.load(keys.folder).keys.items()
    assert (made.aircraft, made.key_id, made.secret) == ("kite", key_id, key.secret)
    assert (key.role, key.name, key.revoked) == ("pilot", "tablet", False)
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert key.aircraft == "kite"
    assert pairing_of(keys("show", "tablet")) == made


def test_a_revoked_key_is_listed_and_shown_no_more(keys):
    first = pairing_of(keys("add", "--role", "observer", "--name", "phone"))
    again = keys("add", "--role", "pilot", "--name", "phone")
    assert (again.status, again.codes) == (1, ["key_exists"])
    assert keys("revoke", "phone").codes == ["key_revoked"]
    assert keys("show", "phone").codes == ["key_revoked"]
    second = pairing_of(keys("add", "--role", "pilot", "--name", "phone"))
    listed = keys("list")
    assert first.key_id in listed.out
    assert second.key_id in listed.out
    assert first.secret not in listed.out
    rows = json.loads(keys("list", "--json").out)
    assert [each["state"] for each in rows] == ["revoked", "valid"]
    assert rows[1]["key_id"] == second.key_id and second.secret not in str(rows)
    assert pairing_of(keys("show", "phone")) == second


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (("add", "--role", "pilot", "--name", "a b"), "key_invalid"),
        (("add", "--role", "pilot", "--name", "a", "--not-after", "soon"), "key_invalid"),
        (("revoke", "nobody"), "key_unknown"),
        (("show", "nobody"), "key_unknown"),
    ],
)
def test_mistakes_have_a_code(keys, words, code):
    assert keys(*words).codes == [code]


def test_the_picture_has_the_mode_of_a_secret(keys, tmp_path):
    png = tmp_path / "key.png"
    keys("add", "--role", "pilot", "--name", "tablet", "--png", str(png))
    assert png.read_bytes().startswith(b"\x89PNG")
    assert stat.S_IMODE(png.stat().st_mode) == 0o600


@pytest.mark.parametrize("mode", [0o640, 0o604])
def test_a_file_that_others_may_read_is_refused(keys, mode):
    keys("add", "--role", "pilot", "--name", "tablet")
    path = keys.folder / KEYS.filename
    path.chmod(mode)
    with pytest.raises(ConfigErrors) as caught:
        KEYS.load(keys.folder)
    assert [each.code for each in caught.value.problems] == ["secrets_readable"]
    assert keys("list").codes == ["secrets_readable"]


@pytest.mark.parametrize(
    "text",
    [
        "keys: {0123456789abcdef: {secret: ab, role: pilot, name: a}}",
        "keys: {zz: {secret: '%s', role: pilot, name: a}}" % ("ab" * 32),
        "keys: {0123456789abcdef: {secret: '%s', role: king, name: a}}" % ("ab" * 32),
        "keys: {0123456789abcdef: {secret: '%s', name: a, not_after: x}}" % ("ab" * 32),
    ],
)
def test_a_faulty_file_is_refused_without_its_secrets(tmp_path, text):
    (tmp_path / KEYS.filename).write_text(text, encoding="utf-8")
    (tmp_path / KEYS.filename).chmod(0o600)
    with pytest.raises(ConfigErrors) as caught:
        KEYS.load(tmp_path)
    assert "ab" * 32 not in str(caught.value)


def test_a_text_that_is_no_pairing_is_refused():
    good = "upkey:1:kite:0123456789abcdef:" + "ab" * 32 + ":pilot:tablet"
    assert parse_pairing(f" {good}\n").encode() == good
    for bad in ("", good[:-7], good.replace(":1:", ":2:"), good.replace("pilot", "king")):
        assert parse_pairing(bad) is None
