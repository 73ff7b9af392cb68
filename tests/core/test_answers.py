"""Distances that are built once for whoever asks, and answers that say why there is none."""

import threading

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, Cancelled, Laplacian, SolverError, VertexError
from bihdist_core.distances import distance_types
from bihdist_core.distances.answers import Answer, Distances, failed
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, two_pieces

BIHARMONIC, EXACT = Spec.of("biharmonic"), Spec.of("geodesic", method="exact")


@pytest.fixture
def built(monkeypatch):
    """The specs that are built from now on."""
    specs, build = [], Spec.build
    monkeypatch.setattr(Spec, "build", lambda self, *a, **k: specs.append(self) or build(self, *a, **k))
    return specs


def test_an_answer_is_a_field_with_its_words_and_certificate():
    surface = bumpy(100)
    answer = Distances(Laplacian(surface)).answer(BIHARMONIC, 7)
    assert np.array_equal(answer.field, BiharmonicDistance(surface).from_source(7))
    assert (answer.label, answer.unit, answer.failure) == ("biharmonic, exact", "mesh units", "")
    assert answer.error_estimate.text.startswith("accurate to ")
    assert answer.is_final
    assert not answer.field.flags.writeable


def test_the_field_comes_at_once_and_its_certificate_after():
    distances = Distances(Laplacian(bumpy(100)))
    first = []
    answer = distances.answer(BIHARMONIC, 7, at_once=first.append)
    assert not first[0].is_final
    assert first[0].field is answer.field
    distances.answer(BIHARMONIC, 8, at_once=first.append)
    assert len(first) == 1  # its accuracy is known by now


def test_many_threads_build_a_distance_once(built):
    distances = Distances(Laplacian(bumpy(400)))
    fields: list[np.ndarray] = []
    threads = [
        threading.Thread(target=lambda: fields.append(distances.answer(Spec.of("diffusion"), 3).field))
        for _ in range(6)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert built == [Spec.of("diffusion")]
    assert len(fields) == 6
    assert all(np.array_equal(field, fields[0]) for field in fields)


def test_what_cannot_be_built_is_said_and_not_tried_again(built, no_exact_geodesics):
    distances = Distances(Laplacian(bumpy(60)))
    for source in (0, 1):
        answer = distances.answer(EXACT, source)
        assert "no room for windows" in answer.failure
        assert answer.field is None
        assert answer.is_final
    with pytest.raises(SolverError, match="no room for windows"):
        distances.get(EXACT)
    assert built == [EXACT]


def test_what_is_cancelled_is_built_by_the_next(built):
    def stop(*_):
        raise Cancelled("enough")

    distances = Distances(Laplacian(bumpy(400)))
    with pytest.raises(Cancelled):
        distances.answer(Spec.of("diffusion", t=0.1), 0, stop)
    assert distances.answer(Spec.of("diffusion", t=0.1), 0).field is not None
    assert len(built) == 2


def test_a_vertex_without_a_face_is_an_error_and_no_answer():
    with pytest.raises(VertexError):
        Distances(Laplacian(two_pieces())).answer(BIHARMONIC, 60)


def test_too_poor_a_distance_is_no_answer(monkeypatch):
    monkeypatch.setattr(BiharmonicDistance, "_estimated_accuracy", lambda *_: 0.5)
    answer = Distances(Laplacian(bumpy(60))).answer(BIHARMONIC, 0)
    assert "may be off by 5e-01" in answer.failure


def test_what_is_not_wanted_is_forgotten_but_for_the_last_of_each_word(built, monkeypatch):
    monkeypatch.setattr(distance_types, "FRAME_VERTICES", 0)  # as on a large mesh
    distances = Distances(Laplacian(bumpy(60)))
    times = [Spec.of("diffusion", t=t) for t in (1.0, 2.0, 3.0)]
    for spec in (*times, BIHARMONIC, EXACT):
        distances.get(spec)
    preview = distances.preview(EXACT)
    distances.get(preview)
    distances.keep({EXACT, times[0]})
    built.clear()
    for spec in (times[0], times[2], BIHARMONIC, EXACT, preview):
        distances.get(spec)
    assert not built
    distances.get(times[1])
    assert built == [times[1]]


def test_only_exact_geodesics_on_large_meshes_have_a_preview(monkeypatch):
    distances = Distances(Laplacian(bumpy(60)))
    assert distances.preview(EXACT) is None
    monkeypatch.setattr(distance_types, "FRAME_VERTICES", 59)
    assert distances.preview(EXACT) == Spec.of("geodesic", method="virtual-sources")
    assert distances.preview(BIHARMONIC) is None


def test_failures_in_words():
    assert failed("x", SolverError("It broke.")).failure == "It broke."
    failure = failed("x", MemoryError()).failure
    assert all(words in failure for words in ("not enough memory", "fewer panels", "--simplify", "cluster"))
    assert "ZeroDivisionError" in failed("x", ZeroDivisionError("0")).failure
    assert Answer(label="x").maximum == 0
