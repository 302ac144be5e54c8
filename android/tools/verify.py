"""Checks a finished APK against its manifest and the promises of its Makefile.

``verify.py APK MANIFEST VERSION LIMIT``: package and levels, the version, permissions exactly as in
the manifest (none implied), no required features, no native code, a readable dex, and its size.
``verify.py code VERSION`` prints the version as the number that Android compares.
"""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

PACKAGE = "org.raspilot"
LEAST_SDK = "16"
TARGET_SDK = "29"
NAME = "{http://schemas.android.com/apk/res/android}name"
# aapt implies a touch screen for every app unless its manifest declares it optional.
HARMLESS = {"android.hardware.faketouch", "android.hardware.touchscreen"}


class Fault(NamedTuple):
    """One error: a code, what it concerns, and the sentence to print."""

    code: str
    subject: str
    text: str


def version_code(version: str) -> int:
    """Return a number that increases with the version: 1.2.3 is 10203."""
    major, minor, patch = (int(each) for each in version.split("."))
    return major * 10000 + minor * 100 + patch


def promised(manifest: Path) -> list[str]:
    """Return the permissions in the text of a manifest."""
    root = ElementTree.parse(manifest).getroot()
    return sorted(each.get(NAME, "") for each in root.iter("uses-permission"))


def badging(apk: Path) -> str:
    """Return the output of ``aapt dump badging`` for an APK."""
    command = ["aapt", "dump", "badging", str(apk)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def faults(said: str, asked: list[str], version: str) -> Iterator[Fault]:
    """Yield every error in the badging."""
    expected = {
        f"package: name='{PACKAGE}'": rf"package: name='{re.escape(PACKAGE)}' ",
        f"versionCode='{version_code(version)}'": rf" versionCode='{version_code(version)}' ",
        f"versionName='{version}'": rf" versionName='{re.escape(version)}'",
        f"sdkVersion:'{LEAST_SDK}'": rf"(?m)^sdkVersion:'{LEAST_SDK}'$",
        f"targetSdkVersion:'{TARGET_SDK}'": rf"(?m)^targetSdkVersion:'{TARGET_SDK}'$",
        "launchable-activity": r"(?m)^launchable-activity: ",
    }
    for words, pattern in expected.items():
        if not re.search(pattern, said):
            yield Fault("badging", words, f"the APK does not say {words}")
    given = sorted(re.findall(r"(?m)^uses-permission(?:-sdk-23)?: name='([^']*)'", said))
    if given != asked:
        differing = ", ".join(sorted(set(given) ^ set(asked))) or "one is asked for twice"
        text = f"the permissions are not those of the manifest: {differing}"
        yield Fault("permissions", differing, text)
    for implied in re.findall(r"(?m)^\s*uses-implied-permission: name='([^']*)'", said):
        text = f"the permission {implied} is asked for by implication: name it, or do without"
        yield Fault("implied", implied, text)
    for kind, feature in re.findall(r"(?m)^\s*(uses(?:-implied)?-feature): name='([^']*)'", said):
        if feature not in HARMLESS:
            text = f'a phone must have {feature} ({kind}): say android:required="false"'
            yield Fault("feature", feature, text)
    if "native-code" in said:
        yield Fault("native_code", "", "the APK holds native code")


def dex_fault(apk: Path) -> Fault | None:
    """Return the fault that ``dexdump`` finds in the code's checksum and structure, or None."""
    checked = subprocess.run(["dexdump", "-c", str(apk)], capture_output=True, text=True)
    read = subprocess.run(["dexdump", "-f", str(apk)], capture_output=True, text=True)
    if checked.returncode != 0 or "Checksum verified" not in checked.stdout:
        said = (checked.stderr or checked.stdout).strip()
        return Fault("dex", apk.name, f"dexdump does not verify the code: {said}")
    if read.returncode != 0:
        return Fault("dex", apk.name, f"dexdump cannot read the code: {read.stderr.strip()}")
    return None


def main(arguments: list[str]) -> int:
    """Check the APK that ``arguments`` name; print its size; return the exit status."""
    if arguments[0] == "code":
        print(version_code(arguments[1]))
        return 0
    apk, manifest, version, limit = Path(arguments[0]), Path(arguments[1]), *arguments[2:]
    found = list(faults(badging(apk), promised(manifest), version))
    with zipfile.ZipFile(apk) as opened:
        native = [each for each in opened.namelist() if each.endswith(".so")]
        code = opened.getinfo("classes.dex")
    found += [Fault("native_code", each, f"the APK holds native code: {each}") for each in native]
    if fault := dex_fault(apk):
        found.append(fault)
    size = apk.stat().st_size
    print(
        f"{apk.name} {size} bytes of {limit} (code {code.compress_size}, {code.file_size} unpacked)"
    )
    if size > int(limit):
        found.append(Fault("size", limit, f"the APK has {size} bytes: over its target of {limit}"))
    for each in found:
        print(f"{apk}: {each.text}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
