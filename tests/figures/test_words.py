"""Words on the page as it is drawn: none beyond its edges, none on another, at any width and for any number of panels.

The boxes of words are matplotlib's, of the very page that is written as PDF.
"""

import re
import shutil
import subprocess
from itertools import combinations

import numpy as np
import pytest

import app as bihdist
from app.document.document import Inset
from app.drawing.shapes import Box, Path, Text
from app.figures.bars import bar_limits, bar_words, shared_words
from app.figures.canvas import drawn, matplotlib_settings
from app.figures.draw import Figure, FigurePanel, draw_figure, save_figure
from app.figures.fonts import check_font
from app.figures.layout import lay_out
from app.figures.marks import frame_shapes
from app.figures.page_layout import ComposedPage
from app.figures.shots import Shot, take_shots
from app.figures.size import Size
from app.figures.tex import escaped, sources_in_words
from app.figures.words import LAST, LEAST, Lettering
from app.main import main
from app.marks.primitives import PointMark
from app.scene.levels import round_step
from app.scene.style import LINES
from bihdist_core import OutputError, ParameterError
from bihdist_core.progress import silent
from bihdist_core.sources.source import checked_source
from tests.shapes import bumpy, sphere

LONG = (
    "a field of forty characters in its label",
    "potential_of_the_second_kind_on_mesh_no2",
    "Donaudampfschifffahrtsgesellschaftskapit",
)
SIZES = ("60mm", "85mm", "178mm", "slide", "A0", "640x200", "300x500@96dpi")


@pytest.fixture(scope="module")
def ball():
    return bumpy(100)


def figure_of(ball, count, size, **options):
    fields = [np.linspace(0, 10.0**k, 100) for k in (-7, 0, 6)]
    fields[1] = fields[1] - 0.4
    panels = tuple(
        FigurePanel(
            ball,
            None if failure else fields[k % 3],
            heading=LONG[k % 3],
            hint="what is to be looked for in this panel of the figure" if k % 2 else "",
            label=LONG[k % 3],
            unit="1 / mesh units",
            marks=(PointMark(3, text="+0.00123 at 123456"), PointMark(40, text="another mark at the edge")),
            failure="There is no field here, and this is a sentence on why that is so. " * 2 if failure else "",
            signed=k % 3 == 1 and options.get("range") != "shared",
        )
        for k in range(count)
        for failure in [k == 5]
    )
    return Figure(panels, size=Size.parse(size), **options)


def boxes_of(figure):
    """Of each line of text on the page: its box in units, and the text; and the size of the page."""
    layout = lay_out(figure)
    shots = [
        Shot(
            k, box, np.zeros((4, 4, 4), np.uint8), [], [], [(0, *box.middle), (1, box.right - 1, box.y + 1)], np.eye(3)
        )
        for k, cell in enumerate(layout.cells)
        for box in cell.views
    ]
    with matplotlib_settings(figure.font):
        canvas = drawn(ComposedPage(figure, layout, shots), vector=True)
        renderer = canvas.canvas.get_renderer()
        per_unit = canvas.dpi / 96
        found = [
            (np.array(text.get_window_extent(renderer).extents) / per_unit, text.get_text())
            for text in canvas.axes[0].texts
        ]
    return found, (layout.width, layout.height)


OPTIONS = (
    {"title": "caption"},
    {"range": "shared"},
    {"range": "fraction", "title": "none"},
    {"crop": True},
    {"text": 9.0},
    {"font": "DejaVu Serif", "range": "fraction", "crop": True},
)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("count", [1, 3, 6])
def test_no_word_is_off_the_page_and_none_on_another(ball, size, count):
    # A third of the options each: so all meet all sizes, and all numbers of panels.
    step = SIZES.index(size) + count // 3
    for options in ({}, *(each for k, each in enumerate(OPTIONS) if (k + step) % 3 == 0)):
        if "text" in options:
            options = {**options, "columns": count}
        found, (width, height) = boxes_of(figure_of(ball, count, size, **options))
        assert found
        for box, text in found:
            assert box[0] >= 0, (text, options)
            assert box[1] >= 0, (text, options)
            assert box[2] <= width, (text, options)
            assert box[3] <= height, (text, options)
        for (a, one), (b, other) in combinations(found, 2):
            across, up = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
            # Boxes are as high as the font, which is more than its letters.
            assert not (across > 0 and up > 0.5), (one, other, options)


@pytest.mark.parametrize("size", ["60mm", "85mm"])
def test_as_another_program_reads_the_pdf(ball, size, tmp_path):
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext is not there")
    save_figure(figure_of(ball, 3, size), tmp_path / "f.pdf")
    words = subprocess.run(["pdftotext", "-bbox", tmp_path / "f.pdf", "-"], capture_output=True, text=True, check=True)
    width, height = map(float, re.search(r'<page width="([\d.]+)" height="([\d.]+)"', words.stdout).groups())
    pattern = r'xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">'
    found = [tuple(map(float, box)) for box in re.findall(pattern, words.stdout)]
    assert len(found) > 15
    assert all(a >= 0 and b >= 0 and c <= width and d <= height for a, b, c, d in found)
    for one, other in combinations(found, 2):
        across = min(one[2], other[2]) - max(one[0], other[0])
        # Such boxes have the height of the font, which is more than that of letters.
        up = min(one[3], other[3]) - max(one[1], other[1])
        assert not (across > 0.05 and up > 0.3 * (one[3] - one[1]))


def test_words_wrap_then_shrink_and_are_shortened_last():
    type = Lettering()
    wide = type.width("a few words", 12)
    assert type.fitted(["a few words"], 12, wide, 2) == (12, [("a few words",)])
    size, (lines,) = type.fitted(["a few words"], 12, 0.8 * wide, 2)
    assert (LEAST <= size < 12, lines) == (True, ("a few words",))
    assert type.fitted(["a few words"], 12, 0.6 * wide, 2)[1] == [("a few", "words")]
    size, (lines,) = type.fitted(["a few words " * 20], 12, wide, 2)
    assert size == LAST
    assert len(lines) == 2
    assert lines[1].endswith("…")
    assert Lettering(stays=True).fitted(["a few words " * 20], 12, wide, 2)[0] == 12
    assert type.fitted([""], 12, wide, 2)[1] == [()]


def test_a_size_of_text_is_kept_and_fonts_are_looked_for(ball):
    figure = figure_of(ball, 1, "178mm", text=7.0)
    assert lay_out(figure).label == pytest.approx(7 / 0.75)
    assert lay_out(figure_of(ball, 6, "60mm")).smallest >= 5 - 1e-9
    check_font("dejavu serif")
    with pytest.raises(ParameterError, match=r"No font 'DejaVu Serf' is installed; there is .*DejaVu Serif"):
        figure_of(ball, 1, "85mm", font="DejaVu Serf")


def test_eps_has_letters_and_no_transparency(ball, tmp_path):
    figure = figure_of(ball, 1, "60mm")
    for name in ("a.eps", "b.eps"):
        save_figure(figure, tmp_path / name)
    text = (tmp_path / "a.eps").read_bytes()
    assert text == (tmp_path / "b.eps").read_bytes()
    assert text.startswith(b"%!PS-Adobe-3.0 EPSF-3.0")
    assert b"/FontName /DejaVuSans" in text
    with pytest.raises(OutputError, match="EPS has no transparency"):
        save_figure(figure_of(ball, 1, "85mm", transparent=True), tmp_path / "c.eps")
    assert not (tmp_path / "c.eps").exists()


def test_a_snippet_includes_the_figure_at_its_width_and_says_what_it_shows(mesh_file, tmp_path, capsys):
    out = tmp_path / "my_figure.pdf"
    words = ["figure", mesh_file(bumpy(200)), "--sources", "4", "--size", "85mm", "--tex", "--isolines", "9"]
    words += ["--distance", "biharmonic,diffusion", "-o", str(out)]
    assert main(words) == 0
    text = (tmp_path / "my_figure.tex").read_text()
    assert r"\includegraphics[width=85mm]{\detokenize{my_figure.pdf}}" in text
    caption = re.search(r"\\caption\{(.*)\}\n", text)[1]
    assert "Distances on mesh.off from vertex 4. Biharmonic, exact, 0 to " in caption
    assert "mesh units; diffusion, t = 1, 0 to " in caption
    ends = [float(end) for end in re.findall(r"0 to ([0-9.]+)", caption)]
    first, second = (f"{round_step(end, 9):g}" for end in ends)
    assert f"Isolines every {first} mesh units and {second}" in caption
    assert main([*words[:-3], "biharmonic,diffusion,biharmonic - diffusion", *words[-2:], "--clim", "fraction"]) == 0
    assert re.search(r"Isolines every [0-9.]+ percentage points", (tmp_path / "my_figure.tex").read_text())
    assert "and at 10 equal steps." in (tmp_path / "my_figure.tex").read_text()
    assert main([*words, "--equal-isolines"]) == 0
    assert "Isolines at 9 equal steps." in (tmp_path / "my_figure.tex").read_text()
    assert escaped(r"50% of a_b & {c} \\ −1") == r"50\% of a\_b \& \{c\} \textbackslash{}\textbackslash{} $-$1"
    (tmp_path / "my_figure.tex").write_text("an article")
    assert main(words) == 2
    assert "my_figure.tex exists" in capsys.readouterr().err
    assert (tmp_path / "my_figure.tex").read_text() == "an article"


@pytest.mark.parametrize(
    ("sources", "said"),
    [
        (["4"], "vertex 4"),
        (["4", "9"], "vertices 4 and 9"),
        (["4+9+7"], "the nearest of vertices 4, 9 and 7"),
        (["f3:0.25,0.5"], "the place f3:0.25,0.5"),
        (["loop:1"], "boundary loop 1"),
        (["4+loop:0"], "the nearest of vertex 4 and boundary loop 0"),
        (["4", "loop:0"], "vertex 4; from boundary loop 0"),
        (["+".join(map(str, range(20)))], "the nearest of vertices 0, 1, 2, 3, 4 and 15 more"),
    ],
)
def test_sources_of_all_kinds_are_named_as_what_they_are(sources, said):
    assert sources_in_words([checked_source(words) for words in sources]) == said


@pytest.mark.parametrize("top", [0.4, 0.4001, 0.4159])
def test_lines_stand_on_the_bar_however_near_the_last_one_is_to_its_end(ball, top):
    panel = FigurePanel(ball, np.linspace(0, top, 100), unit="mesh units")
    figure = Figure((panel,), size=Size(600, 500, dpi=96), style=LINES)
    box = lay_out(figure).cells[0].bar.box
    row = draw_figure(figure)[round(box.y + box.height / 2), round(box.x) + 1 : round(box.right) - 1, :3]
    is_line = (row[2:-2] < 225).all(axis=1)
    assert np.diff(is_line.astype(int)).clip(0).sum() == (20 if top > 0.41 else 19)


@pytest.mark.parametrize(("width", "counts"), [(330, [20, 19, 15]), (240, [0, 0, 0])])
def test_isolines_are_on_all_colour_bars_of_a_figure_or_on_none(ball, width, counts):
    tops = (1.048, 1.977, 1.623)
    panels = tuple(FigurePanel(ball, np.linspace(0, top, 100), unit="mesh units") for top in tops)
    figure = Figure(panels, size=Size(3 * width, dpi=288), style=LINES, columns=3)
    picture, found = draw_figure(figure), []
    for cell in lay_out(figure).cells:
        left, top, wide, high = (round(3 * side) for side in (cell.bar.box.x, cell.bar.box.y, cell.bar.box.width, 4))
        is_line = (picture[top + high, left + 3 : left + wide - 3] < 240).all(axis=1)
        found.append(np.diff(is_line.astype(int)).clip(0).sum())
    assert found == counts


def test_a_caption_names_no_vertex_where_a_place_is_the_source(mesh_file, tmp_path):
    out = tmp_path / "a.pdf"
    words = ["figure", mesh_file(bumpy(200)), "--sources", "f7:0.25,0.5", "--distance", "biharmonic", "--tex"]
    assert main([*words, "--size", "200x200", "-o", str(out)]) == 0
    assert "Distances on mesh.off from the place f7:0.25,0.5. " in out.with_suffix(".tex").read_text()


def test_the_unit_stands_before_the_maximum_where_one_bar_is_in_shares(ball):
    field = np.linspace(0, 0.5078, 100)
    panels = tuple(FigurePanel(ball, field, unit=unit) for unit in ("1 / mesh units", "mesh units"))
    of = Figure(panels, range="fraction")
    assert [bar_words(of, k) for k in (0, 1)] == ["1 / mesh units, max\xa00.5078", "mesh units, max\xa00.5078"]
    assert shared_words(of, 0) == "% of each maximum"


@pytest.mark.parametrize("range", ["own", "shared", "fraction"])
def test_a_difference_is_in_percentage_points_in_every_range(ball, range):
    words = "largest +14.2 % at vertex 99: biharmonic is farther"
    distance = FigurePanel(ball, np.linspace(0, 0.5, 100), label="biharmonic", unit="mesh units")
    panels = [
        FigurePanel(ball, np.linspace(-top, top, 100), label="b", unit="percentage points", signed=True, largest=words)
        for top in (14.2, 7.1)
    ]
    of = Figure((distance, *panels), range=range)
    assert bar_words(of, 1).replace("\xa0", " ") == "b (percentage points, largest +14.2 % at vertex 99)"
    assert bar_limits(of, 1) == (-14.2, 14.2)
    # Of one unit, they end together unless each has its own.
    assert bar_limits(of, 2)[1] == (7.1 if range == "own" else 14.2)
    assert not of.has_one_bar
    alone = Figure(tuple(panels), range=range)
    assert alone.has_one_bar == (range != "own")
    if alone.has_one_bar:
        # The one bar says what holds for both.
        assert shared_words(alone, 0) == "percentage points"
        assert [bar_words(alone, k).replace("\xa0", " ") for k in (0, 1)] == ["b (largest +14.2 % at vertex 99)"] * 2


def test_numbers_of_insets_stand_on_grounds_inside_the_page():
    surface = sphere(600)
    front = np.argsort(-surface.vertices[:, 2])
    right = int(np.argmax(surface.vertices[:, 0]))
    insets = tuple(Inset(int(vertex), 4.0) for vertex in (front[0], front[8], right))
    panel = FigurePanel(surface, 50 * surface.vertices[:, 1] + 50, insets=insets, views=("front",))
    figure = Figure((panel,), size=Size.parse("300x300"))
    layout = lay_out(figure)
    shots = take_shots(figure, layout, silent)
    page = ComposedPage(figure, layout, shots)
    shapes = [shape for shot in shots if shot.source is not None for shape in frame_shapes(page, shot)]
    numbers = [shape for shape in shapes if isinstance(shape, Text)]
    assert sorted(text.text for text in numbers) == ["1", "1", "2", "2", "3", "3"]
    grounds = []
    for shape in shapes:
        if isinstance(shape, Path) and shape.fill is not None:
            assert shape.fill[:3] == figure.style.background
            (part,) = shape.subpaths
            (x, y), (_, (corner,), *_) = part.start, part.segments
            grounds.append(Box(x, y, corner[0] - x, corner[1] - y))
    for text in numbers:
        x, y = text.x, text.y
        assert 4 < x < layout.width - 4
        assert 8 < y < layout.height
        on = [box for box in grounds if box.x < x - 3 and box.right > x + 3]
        assert any(box.y < y - 6 and box.bottom > y for box in on)


def test_words_stay_with_shapes_on_pages_that_are_higher(ball):
    bare = {"range": "shared", "title": "none"}
    for options in ({}, {"title": "caption"}, bare):
        layout = lay_out(figure_of(ball, 3, "600x900", columns=3, **options))
        (first, *_), last = layout.cells, layout.cells[-1]
        view = first.views[0]
        assert view.height < 1.5 * view.width
        above, under = first.box.y, layout.height - last.box.bottom
        assert above > 100
        assert above == pytest.approx(under, abs=1) or options is bare
        if layout.shared_bar:
            bar = layout.shared_bar.box
            assert bar.y - last.box.bottom < 20 or abs(bar.middle[1] - view.middle[1]) < 20


def test_what_an_inset_enlarges_is_inside_the_view():
    surface = sphere(600)
    low, right = int(np.argmin(surface.vertices[:, 1])), int(np.argmax(surface.vertices[:, 0]))
    panel = FigurePanel(
        surface, surface.vertices[:, 1] + 1, insets=(Inset(low, 4.0), Inset(right, 3.0)), views=("front",)
    )
    figure = Figure((panel,), size=Size.parse("300px"), crop=True)
    layout = lay_out(figure)
    view = layout.cells[0].views[0]
    for shot in take_shots(figure, layout, silent)[1:]:
        frame = shot.source
        assert view.holds(frame.x, frame.y, 1e-9)
        assert view.holds(frame.right, frame.bottom, 1e-9)
        assert frame.width == pytest.approx(frame.height)


def test_a_figure_of_one_column_is_cropped_with_one_bar_and_readable(mesh_file):
    mesh = mesh_file(bumpy(200))
    picture = bihdist.figure(mesh, source=4, layout={"size": "column"})
    figure, layout = picture._figure, lay_out(picture._figure)
    assert (figure.crop, figure.range, len(layout.bars)) == (True, "fraction", 1)
    assert layout.width * 25.4 / 96 == pytest.approx(85, abs=0.01)
    assert layout.smallest >= 6
    assert not any("…" in line for cell in layout.cells for words in cell.words for line in words.lines)
    # What has no bar of fractions, or is asked for otherwise, has its own.
    difference = bihdist.figure(mesh, ["biharmonic", "biharmonic - geodesic"], 4, layout={"size": "column"})._figure
    assert (difference.crop, difference.range) == (True, "own")
    asked = bihdist.figure(mesh, source=4, layout={"size": "column", "crop": False}, look={"clim": "own"})._figure
    assert (asked.crop, asked.range, lay_out(asked).smallest >= 6) == (False, "own", True)
    assert not bihdist.figure(mesh, source=4, layout={"size": "85mm"})._figure.crop


@pytest.mark.parametrize("panels", [1, 4])
def test_a_cropped_page_with_a_width_on_paper_is_as_wide(ball, panels):
    layout = lay_out(figure_of(ball, panels, "85mm", columns=1, crop=True))
    assert layout.page[0] == 1004


def sizes_of(count, size):
    """Of the headings, and of the smallest words, in pixels, with short names."""
    ball = bumpy(100)
    panels = tuple(
        FigurePanel(ball, np.linspace(0, 1.0, 100), heading="biharmonic, exact", unit="mesh units")
        for _ in range(count)
    )
    layout = lay_out(Figure(panels, size=Size.parse(size)))
    headings = [words for cell in layout.cells for words in cell.words if words.is_bold]
    texts = [words.size for cell in layout.cells for words in (*cell.words, *cell.bar.texts) if words.lines]
    return layout, headings, layout.scale * min(texts)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 6])
def test_words_of_a_slide_are_read_from_afar(count):
    layout, headings, smallest = sizes_of(count, "slide")
    assert layout.page == (1920, 1080)
    assert smallest >= 24  # pixels
    assert layout.scale * headings[0].size >= 1.2 * smallest


def test_headings_of_narrow_panels_are_no_larger_than_labels_and_leave_the_width_to_the_shape():
    layout, headings, smallest = sizes_of(3, "column")
    for words, cell in zip(headings, layout.cells, strict=True):
        assert layout.scale * words.size <= 1.05 * smallest
        assert layout.lettering.width(words.lines[0], words.size, bold=True) < 0.8 * cell.box.width
    _, wide, smallest = sizes_of(1, "column")  # which has room for them
    assert wide[0].size > 1.15 * smallest / layout.scale
