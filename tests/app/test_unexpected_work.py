"""Work in the background that fails as nobody foresaw: it is noted once with its traceback, whoever asked is told, and
the next request is worked on."""

import logging
import queue
import threading
from types import SimpleNamespace

import numpy as np
import pytest

from app.document.document import MeshFile
from app.session.latest_request_worker import LatestRequestWorker
from app.session.loaded_mesh import LoadedMesh
from app.session.questions import DistanceQuestion
from app.tools.pins.distances import PairwiseDistances
from app.tools.profile.paths import PathWanted, PathWorker
from app.tools.quality.quality_worker import QualityWorker
from app.tools.regions.division import Dividing, RegionsQuestion
from bihdist_core import MeshError
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.distances.distance_types import Spec
from bihdist_core.unexpected import LOG, note_unexpected
from tests.shapes import bumpy
from tests.waiting import PATIENCE

BIHARMONIC = Spec.of("biharmonic")
SAID = "Unexpected error: ZeroDivisionError: once"


@pytest.fixture
def noted():
    """What is logged, as sentences with their details."""
    found = queue.Queue()

    class Keep(logging.Handler):
        def emit(self, record):
            found.put((record.getMessage(), logging.Formatter().formatException(record.exc_info)))

    handler = Keep()
    LOG.addHandler(handler)
    yield found
    LOG.removeHandler(handler)


@pytest.fixture
def loaded():
    return LoadedMesh(MeshFile("A", "a.off", "0"), bumpy(200))


class Once:
    """Fails when it is called first, and is what it stands for afterwards."""

    def __init__(self, there):
        self._there, self.calls = there, 0

    def __call__(self, *arguments, **options):
        self.calls += 1
        if self.calls == 1:
            raise ZeroDivisionError("once")
        return self._there(*arguments, **options)


@pytest.fixture
def fails_once(monkeypatch):
    def patch(where):
        from importlib import import_module

        module, name = where.rsplit(".", 1)
        monkeypatch.setattr(where, Once(getattr(import_module(module), name)))

    return patch


def check_noted(noted):
    sentence, details = noted.get(timeout=PATIENCE)
    assert sentence == SAID
    assert "Traceback" in details
    assert details.endswith("ZeroDivisionError: once")
    assert noted.empty()


def pumped(posted, done):
    while not done():
        posted.get(timeout=PATIENCE)()


def test_an_error_that_was_foreseen_is_not_noted(noted):
    for error in (MeshError("no"), MemoryError()):
        note_unexpected(error)
        failure_in_words(error)
    assert noted.empty()


def test_one_error_is_noted_once_whoever_hears_of_it(noted):
    error = ZeroDivisionError("once")
    note_unexpected(error)
    assert failure_in_words(error) == SAID
    assert noted.get()[0] == SAID
    assert noted.empty()


def test_a_lane(noted):
    told, done = queue.Queue(), queue.Queue()
    work = Once(lambda request, lane: done.put(request))
    lane = LatestRequestWorker("a", work, lambda *_: None, lambda request, error: told.put((request, error)))
    lane.submit(1)
    request, error = told.get(timeout=PATIENCE)
    assert (request, str(error)) == (1, "once")
    check_noted(noted)
    lane.submit(2)
    assert done.get(timeout=PATIENCE) == 2
    lane.close()


@pytest.mark.parametrize("who", ["failed", "report"])
def test_a_lane_whose_listener_fails_goes_on(noted, who):
    done, heard = queue.Queue(), threading.Event()

    def tell(*_):
        if not heard.is_set():
            heard.set()
            raise ZeroDivisionError("once")

    def work(request, lane):
        if request == 1 and who == "failed":
            raise MeshError("no")
        done.put(request)

    silent = {"report": lambda *_: None, "failed": lambda *_: None, who: tell}
    lane = LatestRequestWorker("a", work, silent["report"], silent["failed"])
    lane.submit(1)
    check_noted(noted)
    lane.submit(2)
    while done.get(timeout=PATIENCE) != 2:
        pass
    lane.close()


def test_quality(noted, loaded, fails_once):
    fails_once("app.tools.quality.quality_worker.other_extrema")
    posted = queue.Queue()
    quality = QualityWorker(posted.put, lambda: None)
    one, other = (DistanceQuestion(loaded.mesh, "voronoi", BIHARMONIC, at) for at in (3, 5))
    for question in (one, other):
        quality.ask({question: (loaded, question.answer(loaded))})
        pumped(posted, lambda question=question: quality.found(question).is_whole)
    assert quality.found(one).failure == SAID
    assert quality.found(other).whole is not None
    check_noted(noted)
    quality.close()


def test_triangles(noted, loaded, fails_once):
    fails_once("app.tools.quality.quality_worker.triangle_samples")
    posted = queue.Queue()
    quality = QualityWorker(posted.put, lambda: None)
    question = DistanceQuestion(loaded.mesh, "voronoi", BIHARMONIC, 3)
    quality.ask({question: (loaded, question.answer(loaded))})
    pumped(posted, lambda: quality.found(question).is_sampled)
    assert quality.found(question).triangles_failure == SAID
    check_noted(noted)
    quality.close()


def test_regions(noted, loaded, fails_once):
    fails_once("app.tools.regions.division.voronoi_regions")
    posted = queue.Queue()
    dividing = Dividing(posted.put, lambda panel: None)
    for places in ((3, 50), (3, 60)):
        question = RegionsQuestion(loaded.mesh, "voronoi", BIHARMONIC, places)
        dividing.ask({0: (question, loaded)})
        pumped(posted, lambda: dividing.is_complete)
        assert dividing.divided(0).failure == (SAID if places == (3, 50) else "")
    check_noted(noted)
    dividing.close()


def test_distances_among_pins(noted, loaded, fails_once):
    fails_once("app.tools.pins.distances.distances_among")
    posted = queue.Queue()
    among = PairwiseDistances(posted.put, lambda: None)
    among.ask(loaded, "voronoi", [BIHARMONIC], [3, 5])
    pumped(posted, lambda: among.failure(BIHARMONIC))
    assert among.failure(BIHARMONIC) == SAID
    check_noted(noted)
    among.ask(loaded, "barycentric", [BIHARMONIC], [3, 5])
    pumped(posted, lambda: among.matrix(BIHARMONIC) is not None)
    among.close()


def test_paths(noted, monkeypatch):
    told = queue.Queue()
    worker = PathWorker(lambda call: call(), lambda wanted, found: told.put(found), lambda text: None)
    worker._maker = SimpleNamespace(path=Once(worker._maker.path))
    surface = bumpy(200)
    worker.ask(PathWanted(surface, (3, 50), "auto"))
    assert told.get(timeout=PATIENCE) == SAID
    check_noted(noted)
    worker.ask(PathWanted(surface, (3, 60), "auto"))
    assert np.isfinite(told.get(timeout=PATIENCE).length)
    worker.close()


def test_answers(noted, desk, mesh_file, monkeypatch):
    monkeypatch.setattr(DistanceQuestion, "answer", Method(Once(DistanceQuestion.answer)))
    d = desk([BIHARMONIC])
    d.show(mesh_file(bumpy(200)), 3)
    d.complete()
    assert d.answers[0].failure == SAID
    check_noted(noted)
    d.click(5)
    d.complete()
    assert d.answers[0].field is not None


def test_reading(noted, desk, mesh_file):
    d = desk([BIHARMONIC], prepare=Once(lambda surface: None))
    path = mesh_file(bumpy(200))
    d.show(path, 3)
    d.until_told(SAID)
    check_noted(noted)
    d.view.unexpected.clear()
    d.session.open(path)
    assert d.complete().mesh().surface.n_vertices == 200


def test_a_document_that_cannot_be_resolve_points(noted, desk, mesh_file, monkeypatch):
    monkeypatch.setattr(LoadedMesh, "resolve_points", Method(Once(LoadedMesh.resolve_points)))
    d = desk([BIHARMONIC])
    path = mesh_file(bumpy(200))
    d.show(path, 3)
    d.until_told(SAID)
    check_noted(noted)
    d.view.unexpected.clear()
    d.session.open(path)
    assert d.complete().mesh().surface.n_vertices == 200


class Method:
    """A function in the place of a method."""

    def __init__(self, function):
        self._function = function

    def __get__(self, instance, owner):
        from functools import partial

        return partial(self._function, instance)
