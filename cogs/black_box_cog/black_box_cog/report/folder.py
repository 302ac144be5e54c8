"""The folder of a report: the page, and the pictures beside it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from black_box_cog.export.output import make_folder, write_file
from black_box_cog.pictures.canvas import PictureError
from black_box_cog.report.content import ReportContent
from black_box_cog.report.images import ImageSet, image_sets
from black_box_cog.report.page import page_of
from up.cli.cli_error import CliError

PAGE = "report.html"


def write_report(
    content: ReportContent,
    folder: Path,
    *,
    may_overwrite: bool,
    on_missing: Callable[[str], object],
) -> list[Path]:
    """Write page and pictures; return the files, the page first.

    Without matplotlib the page has text, tables and an SVG track, and ``on_missing`` is called.
    Raises CliError for an existing file or a failed write, FlightLogError.
    """
    if not may_overwrite and (folder / PAGE).exists():
        raise CliError(f"{folder / PAGE} is there already: say --force to overwrite it")
    make_folder(folder)
    images: dict[str, ImageSet] = {}
    missing = ""
    try:
        images = {image.name: image for image in image_sets(content)}
    except PictureError as error:
        missing = f"No pictures: {error}."
        on_missing(missing)
    page = page_of(content, images, missing).encode()
    files = [folder / PAGE]
    write_file(files[0], page, may_overwrite=may_overwrite)
    for image in images.values():
        path = folder / f"{image.name}.png"
        write_file(path, image.wide, may_overwrite=may_overwrite)
        files.append(path)
    return files
