"""Random edits of a document in a session, undone and redone: what is shown equals a fresh computation."""

import json
import os
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, settings, strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)

from app.document.camera import Camera
from app.document.document import Document, comparison, content
from app.document.edits import add_panel, move_panel, move_source, put_point, remove_panel, show_in
from app.document.form import document_data, document_from
from app.document.history import History
from app.document.quantities import Difference, DistanceFrom
from app.session.session import Session
from bihdist_core import Laplacian
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, grid, two_pieces
from tests.silent_view import SilentView

SURFACES = (bumpy(60), grid(5, 4), two_pieces())
LAPLACIANS = {(k, areas): Laplacian(s, areas) for k, s in enumerate(SURFACES) for areas in ("voronoi", "barycentric")}
SPECS = st.sampled_from(
    [
        Spec.of("biharmonic"),
        Spec.of("commute-time"),
        Spec.of("diffusion", t=0.25),
        Spec.of("diffusion"),
        Spec.of("truncated", k=8),
        Spec.of("power", alpha=3.0),
        Spec.of("geodesic", method="dijkstra"),
        Spec.of("geodesic", method="heat"),
        Spec.of("geodesic", method="exact"),
    ]
)
VERTICES = st.integers(0, 29)  # which all surfaces have, on their largest component
STEPS = int(os.environ.get("SESSION_STEPS", "50"))
"""Steps of a run; SESSION_STEPS=1000 for a long one."""
RUNS, NIGHTLY_RUNS = 20, 200
"""Seconds: lanes stand back, so that on a busy machine they get next to nothing."""


@cache
def fresh_field(spec, mesh, areas, vertex):
    """By a distance built for it alone."""
    return spec.build(LAPLACIANS[mesh, areas]).from_source(vertex)


class AnySession(RuleBasedStateMachine):
    """The model is a list of documents and a place in it; a drag is one step."""

    @initialize()
    def begin(self):
        self.view = SilentView()
        self.session = Session(
            self.view, self.view.posted.put, known_up=lambda sha256: "y"
        )  # guessing it takes a while
        self.meshes = [self.session.given.add_surface(surface) for surface in SURFACES]
        document = comparison("", (Spec.of("biharmonic"),), (3,))
        # Open once, a surface is there at once afterwards.
        for mesh in reversed(self.meshes):
            self.session.show(replace(document, surfaces=(mesh,)))
            self.view.run_until(
                lambda mesh=mesh: self.document.surfaces == (mesh,) and self.session.loaded() is not None
            )
        self.session.history = History(self.document)
        self.steps, self.place, self.key = [self.document], 0, ""

    @property
    def document(self) -> Document:
        return self.session.document

    def show(self, document, key="", live=False):
        self.session.show(document, key, live=live)
        if content(document) == content(self.steps[self.place]):
            self.key = key and self.key
            self.steps[self.place] = document
            return
        if key and key == self.key:
            back = self.place and content(document) == content(self.steps[self.place - 1])
            self.place -= bool(back)
            self.key = "" if back else key
        else:
            self.place += 1
            self.key = key
        del self.steps[self.place :]
        self.steps.append(document)

    def some_panel(self, number):
        return self.document.panels[number % len(self.document.panels)].id

    # ------------------------------------------------------------------ edits
    @rule(number=st.integers(0, 9), vertex=VERTICES)
    def click(self, number, vertex):
        if self.document.panels:
            self.show(move_source(self.document, self.some_panel(number), vertex))

    @rule(number=st.integers(0, 9), vertices=st.lists(VERTICES, min_size=1, max_size=6))
    def drag(self, number, vertices):
        if not self.document.panels:
            return
        panel = self.some_panel(number)
        for vertex in vertices:
            self.show(move_source(self.document, panel, vertex), key=f"drag {panel}", live=True)
        self.show(self.document)

    @rule(spec=SPECS, number=st.integers(0, 9), key=st.sampled_from(["", "slider"]))
    def choose(self, spec, number, key):
        if self.document.panels:
            panel = self.some_panel(number)
            shows = self.document.panel(panel).shows
            self.show(
                show_in(self.document, panel, shows.with_parts((replace(shows.parts[0], spec=spec), *shows.parts[1:]))),
                key,
            )

    @rule(spec=SPECS, name=st.sampled_from(["source", "second"]), vertex=VERTICES)
    def add(self, spec, name, vertex):
        if len(self.document.panels) < 5:
            self.show(add_panel(put_point(self.document, name, vertex), DistanceFrom(spec, name)))

    @rule(one=SPECS, other=SPECS, name=st.sampled_from(["source", "second"]), vertex=VERTICES)
    def subtract(self, one, other, name, vertex):
        if len(self.document.panels) < 5:
            document = put_point(self.document, name, vertex)
            self.show(add_panel(document, Difference(DistanceFrom(one, name), DistanceFrom(other, "source"))))

    @rule(number=st.integers(0, 9))
    def remove(self, number):
        if self.document.panels:
            self.show(remove_panel(self.document, self.some_panel(number)))

    @rule(number=st.integers(0, 9), place=st.integers(0, 5))
    def move(self, number, place):
        if self.document.panels:
            self.show(move_panel(self.document, self.some_panel(number), place))

    @rule(mesh=st.integers(0, len(SURFACES) - 1), areas=st.sampled_from(["voronoi", "barycentric"]))
    def open(self, mesh, areas):
        self.show(replace(self.document, surfaces=(self.meshes[mesh],), areas=areas))

    @rule(count=st.integers(0, 50))
    def isolines(self, count):
        self.show(replace(self.document, isolines=count), "isolines")

    @rule(z=st.floats(1, 9))
    def look(self, z):
        camera = Camera((0.0, 0.0, z), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.5, 0.5))
        self.session.set_view(camera)
        if camera == self.steps[self.place].camera:
            self.key = ""  # the present itself ends a row of equal keys, and a camera that moves does not
        self.steps[self.place] = replace(self.steps[self.place], camera=camera)

    @rule()
    def cancel(self):
        self.session.cancel()

    # ------------------------------------------------------------------ history
    def as_seen_here(self, place):
        there, here = self.steps[place], self.document
        return replace(there, camera=here.camera) if there.surfaces == here.surfaces else there

    @precondition(lambda self: self.place > 0)
    @rule()
    def undo(self):
        expected = self.as_seen_here(self.place - 1)
        self.session.undo()
        self.place, self.key = self.place - 1, ""
        assert self.document == expected
        self.steps[self.place] = expected

    @precondition(lambda self: self.place < len(self.steps) - 1)
    @rule()
    def redo(self):
        expected = self.as_seen_here(self.place + 1)
        self.session.redo()
        self.place, self.key = self.place + 1, ""
        assert self.document == expected
        self.steps[self.place] = expected

    @rule()
    def to_the_start_and_back(self):
        """Equal documents at both ends, but for where they are seen from."""
        place, here = self.place, self.document
        for _ in range(place):
            self.session.undo()
        assert not self.session.history.can_undo
        assert content(self.document) == content(self.steps[0])
        for _ in range(place):
            self.session.redo()
        assert self.document == here
        self.key = ""

    # ------------------------------------------------------------------ what must be true
    def wait(self):
        """Until every panel is answered; after `cancel` only what is asked again is."""
        self.session.show(self.document)
        self.key = ""
        self.view.run_until(lambda: self.session.is_complete)

    @rule()
    def what_is_shown_is_what_a_fresh_computation_gives(self):
        self.wait()
        assert list(self.session.shown) == [] or set(self.session.shown) == {p.id for p in self.document.panels}
        mesh = self.meshes.index(self.document.surfaces[0])
        for panel in self.document.panels:
            fresh = self.fresh(panel.shows, mesh)
            answer = self.session.shown[panel.id].answer
            assert not answer.failure
            small = 1e-8 * np.nanmax(np.abs(fresh), initial=1e-3)
            assert np.allclose(answer.field, fresh, rtol=1e-7, atol=small, equal_nan=True)

    def fresh(self, shows, mesh):
        if isinstance(shows, Difference):
            a, b = (self.fresh(part, mesh) for part in (shows.minuend, shows.subtrahend))
            return 100 * (a / np.nanmax(a) - b / np.nanmax(b))
        return fresh_field(shows.spec, mesh, self.document.areas, self.document.point(shows.point).at)

    @invariant()
    def the_history_knows_where_it_is(self):
        if hasattr(self, "session"):
            history = self.session.history
            assert (history.can_undo, history.can_redo) == (self.place > 0, self.place < len(self.steps) - 1)

    @invariant()
    def the_document_can_be_written_and_read(self):
        if hasattr(self, "session"):
            assert document_from(json.loads(json.dumps(document_data(self.document)))) == self.document

    def teardown(self):
        if hasattr(self, "session"):
            self.what_is_shown_is_what_a_fresh_computation_gives()
            self.session.close()


def test_random_edits_show_what_a_fresh_computation_gives():
    _run(RUNS)


@pytest.mark.nightly
def test_many_random_edits_show_what_a_fresh_computation_gives():
    _run(NIGHTLY_RUNS)


def _run(count):
    is_derandomized = "SESSION_STEPS" not in os.environ
    options = {"deadline": None, "suppress_health_check": list(HealthCheck), "derandomize": is_derandomized}
    run_state_machine_as_test(AnySession, settings=settings(max_examples=count, stateful_step_count=STEPS, **options))
