"""The claims of an APK are compared with its manifest and with the project's promises."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from tests.support.android import ANDROID, make, need_android

sys.path.insert(0, str(ANDROID / "tools"))
import verify

FIXTURE = Path(__file__).parents[1] / "fixtures" / "android_app" / "raspilot"
PERMISSION = '<uses-permission android:name="android.permission.{}" />\n    <application'


def faults(folder, old="", new="", version="0.1.0", asked=None):
    """Compile the fixture's resources with its manifest changed; return the findings."""
    need_android()
    shutil.copytree(FIXTURE, folder / "raspilot")
    manifest = folder / "raspilot" / "AndroidManifest.xml"
    text = manifest.read_text()
    assert old in text
    manifest.write_text(text.replace(old, new) if old else text)
    build = folder / "build"
    make(f"RASPILOT={folder / 'raspilot'}", f"BUILD={build}", f"{build}/resources.apk")
    promised = verify.promised(manifest) if asked is None else asked
    return list(verify.faults(verify.badging(build / "resources.apk"), promised, version))


def test_the_fixture_is_as_promised(tmp_path):
    assert faults(tmp_path) == []


def test_another_version_is_found(tmp_path):
    assert "the APK does not say versionCode='10203'" in faults(tmp_path, version="1.2.3")


def test_a_permission_that_is_not_promised_is_found(tmp_path):
    found = faults(tmp_path, asked=[])
    assert found == ["the permissions are not those of the manifest: android.permission.INTERNET"]


def test_a_permission_that_is_missing_is_found(tmp_path):
    found = faults(tmp_path, asked=["android.permission.INTERNET", "android.permission.VIBRATE"])
    assert found == ["the permissions are not those of the manifest: android.permission.VIBRATE"]


def test_an_implied_permission_is_found(tmp_path):
    found = faults(tmp_path, "<application", PERMISSION.format("WRITE_EXTERNAL_STORAGE"))
    assert any("READ_EXTERNAL_STORAGE is asked for by implication" in each for each in found)


def test_a_feature_that_a_phone_must_have_is_found(tmp_path):
    found = faults(tmp_path, "<application", PERMISSION.format("ACCESS_FINE_LOCATION"))
    assert any("a phone must have android.hardware.location" in each for each in found)


def test_a_manifest_that_says_other_levels_is_found(tmp_path):
    sdk = '<uses-sdk android:minSdkVersion="21" android:targetSdkVersion="28" />\n    <application'
    found = faults(tmp_path, "<application", sdk)
    assert "the APK does not say sdkVersion:'16'" in found
    assert "the APK does not say targetSdkVersion:'29'" in found


def test_the_version_is_a_number_that_rises():
    assert [verify.version_code(each) for each in ("0.1.0", "0.1.1", "0.2.0", "1.0.0")] == [
        100,
        101,
        200,
        10000,
    ]
