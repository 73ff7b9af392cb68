"""A guide of one page and one example is built by Sphinx as the whole is; what is wrong with it stops the build."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "assets/guide"

for name in ("myst_parser", "pydata_sphinx_theme", "sphinx_copybutton", "sphinx_design", "sphinx_gallery"):
    pytest.importorskip(name, reason="the guide's build is not installed: .ci/set-up guide")

PAGE = """# A page

Formulas such as $\\\\lambda_k^2$ need no script; {py:func}`bihdist.tips` is a name, {kbd}`F1` a key.

```{python}
from PIL import Image

Image.new("RGB", (40, 30), "red").save("red.png")
print("twice", 2 * 21)
```

::::{tab-set}
:sync-group: way

:::{tab-item} Python
:sync: python
```{python}
print("in a tab", 3 * 21)
```
:::
::::

```{python}
:hide-code:
:live: pages/live.html
:alt: A still picture
:caption: Click [it](#a-page).
from pathlib import Path

Image.new("RGB", (40, 30), "green").save("still.png")
Path("pages").mkdir()
Path("pages/live.html").write_text("<p>It computes.</p>")
```

```{file} ids.txt
12
```

```{shell}
:hide-code:
:hide-output:
bihdist info --solver
```

```{eval-rst}
.. autofunction:: bihdist.tips
```

```{toctree}
gallery/auto/index
```
"""
EXAMPLE = '''"""
An example
==========

Of a picture.
"""

from PIL import Image

Image.new("RGB", (40, 30), "blue").save("one.png")
'''


@pytest.fixture
def source(tmp_path):
    """The sources of the small guide."""
    source = tmp_path / "source"
    for name in ("look", "templates"):
        shutil.copytree(GUIDE / name, source / name)
    shutil.copy(GUIDE / "conf.py", source)
    (source / "index.md").write_text(PAGE.replace("\\\\", "\\"))
    (source / "gallery").mkdir()
    (source / "gallery/GALLERY_HEADER.rst").write_text("Gallery\n=======\n")
    (source / "gallery/one.py").write_text(EXAMPLE)
    return source


def build(source):
    """The exit status of a build, and what it prints, in a process of its own."""
    code = "import sys\nfrom pathlib import Path\nfrom assets.guide.building.build import build\n"
    code += "raise SystemExit(build(*map(Path, sys.argv[1:])))"
    folders = [source, source.with_name("pages"), source.with_name("guide")]
    there = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", code, *folders], cwd=ROOT, env=there, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_a_small_guide(source):
    status, said = build(source)
    assert status == 0, said
    guide = source.with_name("guide")
    page = (guide / "index.html").read_text(encoding="utf-8")
    assert "twice 42" in page
    assert "in a tab 63" in page
    assert 'data-sync-group="way"' in page
    assert "<em>Click <a" in page
    assert "ids.txt" in page
    assert "<msubsup>" in page
    assert "info --solver" not in page
    assert 'id="bihdist.tips"' in page
    assert (guide / "_images/red.webp").is_file()
    assert 'alt="A still picture"' in page
    assert '<iframe src="_blocks/index/pages/live.html" title="A still picture" loading="lazy"' in page
    assert (guide / "_blocks/index/pages/live.html").is_file()
    example = (guide / "gallery/auto/one.html").read_text(encoding="utf-8")
    assert 'download="one.py"' in example
    assert (guide / "_images/sphx_glr_one_001.webp").is_file()
    assert "red.png" in page
    assert '"gallery/auto/one.html"' in (guide / "search-index.js").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ("[nowhere](nothing.md)", "nothing.md"),
        ("[nowhere](#no-heading)", "no-heading"),
        ("```{python}\n1 / 0\n```", "ZeroDivisionError"),
        ("![no picture](none.png)", "none.png"),
    ],
)
def test_what_is_wrong_stops_the_build(source, wrong, told):
    shutil.rmtree(source / "gallery")
    (source / "gallery").mkdir()
    (source / "gallery/GALLERY_HEADER.rst").write_text("Gallery\n=======\n")
    (source / "index.md").write_text(f"# A page\n\n{wrong}\n")
    status, said = build(source)
    assert status == 1
    assert told in said
    assert not source.with_name("guide").exists()
