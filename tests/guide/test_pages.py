"""Each block of the guide's pages that runs at the build runs here, without Sphinx."""

from pathlib import Path

import pytest

from assets.guide.building.blocks import blocks_of, run_page

GUIDE = Path(__file__).parents[2] / "assets/guide"
PAGES = sorted(page for page in GUIDE.rglob("*.md") if blocks_of(page.read_text(encoding="utf-8")))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(GUIDE).with_suffix("").as_posix())
def test_blocks_run(page, tmp_path):
    outcomes = run_page(page, tmp_path)
    for outcome in outcomes:
        assert all((tmp_path / picture).stat().st_size for picture in outcome.pictures)
