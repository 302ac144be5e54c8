import json
import subprocess

import pytest

from tests.ground.aircraft import UP_GROUND, codes, environment
from tests.support.waiting import DEADLINE_S
from up.errors import UserError
from up.protocols.pairing import Pairing
from up_ground.key_store import FILE, PAGE_FILE, KeyStore, page_key

KITE = Pairing("kite", "0123456789abcdef", "ab" * 32, "pilot", "tablet")
OTHER = Pairing("other", "0123456789abcdef", "cd" * 32, "observer", "phone")


def pair(folder, *words, text=""):
    return subprocess.run(
        [str(UP_GROUND), "pair", *words],
        env=environment(folder, 1),
        input=text,
        capture_output=True,
        text=True,
        timeout=DEADLINE_S,
    )


def test_a_pasted_text_is_stored_for_this_user_alone(tmp_path):
    done = pair(tmp_path, text=KITE.encode() + "\n")
    assert (done.returncode, codes(done.stdout)) == (0, ["paired"])
    assert KITE.secret not in done.stdout + done.stderr
    store = KeyStore(tmp_path / "state" / "up-ground")
    assert store.get("kite") == KITE
    assert (tmp_path / "state" / "up-ground" / FILE).stat().st_mode & 0o777 == 0o600
    listed = pair(tmp_path, "--list", "--json").stdout
    assert [each["aircraft"] for each in json.loads(listed)] == ["kite"]
    assert KITE.secret not in listed
    bad = pair(tmp_path, text="upkey:1:nonsense\n")
    assert (bad.returncode, codes(bad.stderr)) == (2, ["pairing_invalid"])


def test_one_key_for_each_aircraft_until_it_is_forgotten(tmp_path):
    store = KeyStore(tmp_path)
    store.put(OTHER)
    store.put(KITE)
    newer = Pairing("kite", "f" * 16, "12" * 32, "observer", "laptop")
    store.put(newer)
    assert store.all() == {"other": OTHER, "kite": newer}
    assert store.forget("kite")
    assert not store.forget("kite")
    assert store.all() == {"other": OTHER}


def test_a_file_that_others_may_read_is_refused(tmp_path):
    store = KeyStore(tmp_path)
    store.put(KITE)
    (tmp_path / FILE).chmod(0o644)
    with pytest.raises(UserError) as caught:
        store.get("kite")
    assert caught.value.code == "secrets_readable"


def test_the_key_of_the_page_stays_and_only_this_user_may_read_it(tmp_path):
    key, place = page_key(tmp_path)
    path = tmp_path / PAGE_FILE
    assert path.stat().st_mode & 0o777 == 0o600
    assert len(key) == 16 and key not in place
    assert page_key(tmp_path) == (key, place)
    path.chmod(0o640)
    with pytest.raises(UserError) as caught:
        page_key(tmp_path)
    assert caught.value.code == "secrets_readable"
    path.unlink()
    assert page_key(tmp_path)[0] != key
