"""The options of the verbs that serve a page."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Mapping
from pathlib import Path

DEFAULT_LISTEN = "127.0.0.1:8080"
_HOST_NAME = re.compile(r"[A-Za-z0-9.-]{1,253}", re.ASCII)
_KEY = re.compile(r"[A-Za-z0-9_-]{8,64}", re.ASCII)


def add_page_options(
    parser: argparse.ArgumentParser, environ: Mapping[str, str] = os.environ
) -> None:
    """Add the options of everything that serves a page; the environment's values are defaults."""
    parser.add_argument(
        "--listen",
        default=DEFAULT_LISTEN,
        metavar="ADDRESS:PORT",
        help="address of the page; 0.0.0.0 is every interface (default %(default)s)",
    )
    parser.add_argument(
        "--https",
        type=Path,
        metavar="DIR",
        help="serve by HTTPS, with certificate.pem and key.pem of this folder",
    )
    parser.add_argument(
        "--name",
        action="append",
        type=_host_name,
        metavar="HOST",
        help="another host name of the page, in addition to this machine's",
    )
    parser.add_argument(
        "--tiles",
        default=environ.get("UP_GROUND_TILES", ""),
        metavar="URL",
        help="URL from which this server fetches the map's tiles, with {z}, {x} and {y}; they"
        " are kept on disk (default: none, the map has a grid alone)",
    )
    parser.add_argument(
        "--attribution",
        type=_attribution,
        default="",
        metavar="TEXT",
        help="the map's copyright notice",
    )
    parser.add_argument("--watch-only", action="store_true", help="no page may control")
    parser.add_argument(
        "--key",
        type=_key,
        default=environ.get("UP_GROUND_KEY") or None,
        help="the key that a page signs in with to control, of 8 to 64 letters, digits, _ and -"
        " (default: that in page.key, none on loopback; UP_GROUND_KEY hides it from others here)",
    )


def _host_name(text: str) -> str:
    if not _HOST_NAME.fullmatch(text):
        raise argparse.ArgumentTypeError(f"a name is letters, digits, dots and -, not {text!r}")
    return text


def _attribution(text: str) -> str:
    if len(text) > 200:
        raise argparse.ArgumentTypeError("an attribution has at most 200 characters")
    return text


def _key(text: str) -> str:
    if not _KEY.fullmatch(text):
        raise argparse.ArgumentTypeError("a key is 8 to 64 letters, digits, _ and -")
    return text
