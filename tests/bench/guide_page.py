"""A page of the guide with the table of a run in it."""

from pathlib import Path


def put(page: Path, table: str, begin: str, end: str) -> None:
    """Put the table into a page between the lines `begin` and `end`, in the place of the one that is there."""
    text = page.read_text(encoding="utf-8")
    before, _, rest = text.partition(begin)
    _, marker, after = rest.partition(end)
    if not marker:
        raise SystemExit(f"{page} has no place for the table, between {begin} and {end}.")
    page.write_text(f"{before}{begin}\n{table}\n{end}{after}", encoding="utf-8")
