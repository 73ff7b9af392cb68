"""Blocks of a page are found, run in order, and fail by the page's line."""

import pytest

from assets.guide.building.blocks import Block, BlockError, blocks_of, run_page


def page_of(folder, text):
    page = folder / "page.md"
    page.write_text(text)
    (folder / "inside").mkdir()
    return page, folder / "inside"


def test_blocks_are_found_also_in_lists_and_cards():
    text = "# T\n\n```{shell}\n:hide-output:\nbihdist info hand\n```\n\n````{card} A\n```{python}\na = 1\n```\n````\n"
    text += "- b\n\n  ```{file} ids.txt\n  1\n   2\n  ```\n\n```sh\nbihdist\n```\n"
    assert blocks_of(text) == [
        Block("shell", "bihdist info hand", 3, "", {"hide-output": ""}),
        Block("python", "a = 1", 9),
        Block("file", "1\n 2", 15, "ids.txt"),
    ]


def test_blocks_run_in_order_in_one_folder_and_one_namespace(tmp_path):
    page, folder = page_of(
        tmp_path,
        "```{file} ids.txt\n12\n40\n```\n"
        "```{shell}\n# a note\nbihdist field hand --sources @ids.txt \\\n    -o d.npy\n```\n"
        "```{python}\nimport numpy as np\nd = np.load('d.npy')\n```\n"
        "```{python}\nprint(d.shape)\n```\n",
    )
    outcomes = run_page(page, folder)
    assert "d.npy" in outcomes[1].printed
    assert [outcome.printed for outcome in outcomes[2:]] == ["", "(7569, 2)\n"]
    assert {path.name for path in folder.iterdir()} >= {"ids.txt", "d.npy"}


def test_pictures_are_told(tmp_path):
    page, folder = page_of(
        tmp_path,
        "```{shell}\nbihdist figure hand --sources 12 --size 300x150 -o a.png\n```\n"
        "```{python}\nfrom PIL import Image\nImage.new('L', (2, 2)).save('b.png')\n```\n",
    )
    assert [outcome.pictures for outcome in run_page(page, folder)] == [("a.png",), ("b.png",)]


@pytest.mark.parametrize(
    ("block", "told"),
    [
        ("{shell}\nbihdist info nothing.off\n", "page.md:2: bihdist info nothing.off: exit status 2 instead of 0\n"),
        ("{shell}\nbihdist info --oops\n", "exit status 2"),
        ("{shell}\nbihdist view hand\n", "need no window"),
        ("{shell}\nls\n", "need no window"),
        ("{shell}\n:status: 2\nbihdist info hand\n", "exit status 0 instead of 2"),
        ("{python}\na = 1\na.b\n", "page.md:2: line 4: AttributeError: 'int' object has no attribute 'b'"),
        ("{python}\na = (\n", "SyntaxError"),
        ("{file} ../a\nb\n", "not '../a'"),
        ("{file}\nb\n", "not ''"),
    ],
)
def test_a_block_that_fails(tmp_path, block, told):
    page, folder = page_of(tmp_path, f"\n```{block}```\n")
    with pytest.raises(BlockError) as error:
        run_page(page, folder)
    assert told in str(error.value)


def test_a_failure_that_is_meant(tmp_path):
    page, folder = page_of(tmp_path, "```{shell}\n:status: 2\nbihdist info nothing.off\n```\n")
    assert "nothing.off" in run_page(page, folder)[0].printed
