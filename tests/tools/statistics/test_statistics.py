"""The active panel's field in numbers, as Python has them; isolines and regions in files."""

import numpy as np
import pytest

from app.document.quantities import quantity
from app.document.runs import ids_of
from app.document.shared_parts.selections import Selections
from app.drawing.numbers import number
from bihdist_core import band, field_statistics, rank_correlation, read_surface
from bihdist_core.analysis.truncation import truncation_loss
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import checked_source
from tests.qt.parts import parts
from tests.shapes import bumpy

pytest.importorskip("qtpy")


@pytest.fixture
def loaded(shared_screen):
    shown = [Spec.of("biharmonic"), Spec.of("diffusion"), quantity("biharmonic - diffusion")]
    s = shared_screen(bumpy(1000), shown, 5, (1200, 900))
    s.window.actions_by_word["dock statistics"].trigger()
    s.dock = parts(s.window).docks._docks["statistics"].content
    s.until(lambda: s.dock.facts.facts)
    return s


def activate(s, place):
    s.window.grid.activate(s.document.panels[place].id)
    s.until(lambda: s.dock.statistics is not None)


def test_the_active_panel_in_numbers(loaded):
    s, dock = loaded, loaded.dock
    found = field_statistics(s.session.mesh().surface, s.answers[0].field)
    facts = {words: numbers for words, *numbers in dock.facts.facts}
    assert facts[f"greatest, at vertex {found.greatest_at}"] == [f"{found.greatest:.4g}", "100.0 %"]
    assert abs(float(facts["mean, by area"][0]) / found.mean - 1) < 1e-3
    assert abs(dock.statistics.mean - found.mean) <= 1e-12 * found.greatest
    assert [line[0] for line in dock.quantiles.facts][2] == "50 % of the area up to"
    assert abs(float(dock.quantiles.facts[2][1]) / found.quantiles[2] - 1) < 1e-3


def test_a_difference_has_its_parts_rank_correlation_and_signs(loaded):
    s, dock = loaded, loaded.dock
    activate(s, 2)
    s.until(lambda: dock.facts.facts[-1][0] == "rank correlation")
    a, b, d = (answer.field for answer in s.answers)
    assert dock.facts.facts[-1][1] == f"{rank_correlation(a, b):.4f}"
    worst = int(np.abs(d).argmax())
    assert dock.facts.facts[0] == (
        f"largest, at vertex {worst}",
        f"{number(d[worst], signed=True)} %",
    )
    bars = dock.histogram.bars
    areas = field_statistics(s.session.mesh().surface, d, 40).areas
    assert np.allclose(dock.histogram._shares, areas / areas.sum(), atol=1e-12)
    assert np.argmax([bar.height() for bar in bars]) == areas.argmax()
    # Brown below 0, violet above.
    low, high = dock.histogram._colours[0], dock.histogram._colours[-1]
    assert low[0] > low[2]
    assert high[2] > high[0]


def test_truncation_goes_with_the_slider_and_the_source(loaded):
    from app.document.edits import move_source
    from app.qt.look.look import LOOK

    s, box = loaded, loaded.dock.truncation
    assert box.loss is None
    box.button.click()
    s.until(lambda: box.loss is not None)
    expected = truncation_loss(s.session.mesh().surface, 5)
    assert np.allclose(box.loss.means, expected.means, atol=1e-9)
    box.slider.setValue(12)
    facts = dict(box.facts.facts)
    assert facts["eigenpairs"] == "12"
    s.settle()
    table = box.facts.grab().toImage()
    beside = {table.pixelColor(4, y).name() for y in range(table.height())}
    assert {LOOK.theme.accent.lower(), LOOK.theme.text.lower()} <= beside, "the dots of the two curves"
    assert facts["mean loss, by area"].startswith(f"{100 * expected.means[11]:.3g}"[:3])
    s.session.show(move_source(s.document, 0, 900))
    s.until(lambda: box.loss is not None and box.loss.source == 900)
    activate(s, 1)
    assert box.loss is None
    assert "biharmonic" in box.hint.text()


def test_isolines_and_the_region_between_two_values_are_saved(loaded, tmp_path):
    from app.qt.files.field_files import save_isolines

    s, box = loaded, loaded.dock.levels
    save_isolines(s.window.context, s.window.grid.active, str(tmp_path / "lines.csv"))
    s.until((tmp_path / "lines.csv").exists)
    rows = np.genfromtxt(tmp_path / "lines.csv", delimiter=",", names=True)
    shown = s.panels[0].view.scene.field_actor.levels.values
    assert np.allclose(np.unique(rows["value"]), shown)
    field = s.answers[0].field
    box.low.setText("20 %")
    box.high.setText(f"{field.max() / 2:.17g}")
    s.until(lambda: box.band is not None)
    expected = band(s.session.mesh().surface, field, 0.2 * field.max(), field.max() / 2)
    assert box.band.area == pytest.approx(expected.area, rel=1e-12)
    box.save_region("ids", str(tmp_path / "ids.npy"))
    s.until((tmp_path / "ids.npy").exists)
    assert np.load(tmp_path / "ids.npy").tolist() == expected.vertices.tolist()
    box.save_region("mesh", str(tmp_path / "part.ply"))
    s.until((tmp_path / "part.ply").exists)
    assert read_surface(tmp_path / "part.ply").face_areas.sum() == pytest.approx(expected.area, rel=1e-9)
    box.select()
    assert ids_of(s.document[Selections].selections[0].runs).tolist() == expected.vertices.tolist()
    for words in ("near", "", "5 %"):
        box.low.setText(words)
        box.high.setText("2 %" if words == "5 %" else "")
        s.settle(0.5)
        assert box.band is None
    assert "smaller first" in box.note.text()


def test_the_histogram_is_saved_and_copied(loaded, tmp_path):
    s, dock = loaded, loaded.dock
    dock.save_figure(path=str(tmp_path / "it.svg"))
    s.until((tmp_path / "it.svg").exists)
    text = (tmp_path / "it.svg").read_text()
    assert f"mean {dock.statistics.mean:.4g}" in text
    assert "Biharmonic (mesh units)" in text
    dock.save_numbers(path=str(tmp_path / "it.csv"))
    rows = np.genfromtxt(tmp_path / "it.csv", delimiter=",", names=True)
    assert np.array_equal(rows["area"], dock.statistics.areas)
    assert np.array_equal(rows["to"], dock.statistics.bins[1:])
    dock.copy()
    lines = [line.split("\t") for line in s.application.clipboard().text().splitlines()]
    assert lines[1][0].startswith("greatest, at vertex")
    assert [float(x) for x in lines[3][1:]] == [dock.statistics.mean, dock.statistics.mean / s.answers[0].maximum]
    assert [float(line[1]) for line in lines[-len(dock.statistics.quantiles) :]] == dock.statistics.quantiles.tolist()


def test_nothing_is_saved_or_copied_before_there_are_statistics(loaded, tmp_path):
    loaded.dock.statistics = None
    loaded.dock.save_figure(path=str(tmp_path / "histogram.pdf"))
    loaded.dock.save_numbers(path=str(tmp_path / "histogram.csv"))
    loaded.dock.copy()
    assert all("wait until the panel has a field" in words for words in loaded.refusals)
    assert len(loaded.refusals) == 3
    assert not list(tmp_path.glob("histogram.*"))


def test_truncation_follows_sources_of_other_kinds(loaded):
    from app.document.edits import put_point

    s, box = loaded, loaded.dock.truncation
    box.button.click()
    s.until(lambda: box.loss is not None)
    for words in ("5+900", "f31:0.2,0.5"):
        s.session.show(put_point(s.document, "source", checked_source(words)))
        s.until(lambda words=words: box.loss is not None and box.loss.source == checked_source(words))
        assert np.allclose(box.loss.largest, truncation_loss(s.session.mesh().surface, words).largest, atol=1e-9)


def test_isolines_are_saved_from_the_menu_of_a_place_too(loaded, tmp_path):
    s = loaded
    from app.qt.files.field_files import save_isolines
    from app.qt.panels.events import MenuWanted

    save_isolines(s.window.context, s.document.panels[1].id, str(tmp_path / "lines.csv"))
    s.until((tmp_path / "lines.csv").exists)
    rows = np.genfromtxt(tmp_path / "lines.csv", delimiter=",", names=True)
    assert np.allclose(np.unique(rows["value"]), s.panels[1].view.scene.field_actor.levels.values)
    from qtpy.QtWidgets import QMenu

    middle = s.panels[1].view.rect().center()
    s.panels[1].view.happened.emit(MenuWanted(s.panels[1].view.pick(middle), middle))
    (menu,) = [each for each in s.application.topLevelWidgets() if isinstance(each, QMenu) and each.isVisible()]
    assert "Save isolines…" in [action.text() for action in menu.actions()]
    menu.hide()
