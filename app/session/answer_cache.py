"""Answers that are kept by their questions, as many as a memory holds."""

import threading
from collections import OrderedDict

from bihdist_core.distances.answers import Answer

from .questions import Question

MEMORY = 256_000_000
"""Bytes of fields that are kept: 320 of 100,000 vertices, 32 of a million."""

MOST = 1_000
"""Answers that are kept: of small meshes a memory would hold more than anybody comes back to."""


class AnswerCache:
    """The final answers given last, for any thread: what comes back, by undo or in another panel, costs nothing."""

    def __init__(self, memory: int = MEMORY) -> None:
        self._memory = memory
        self._bytes = 0
        self._answers: OrderedDict[Question, Answer] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, question: Question) -> Answer | None:
        """The answer to a question, None if it is not held."""
        with self._lock:
            if question in self._answers:
                self._answers.move_to_end(question)
            return self._answers.get(question)

    def put(self, question: Question, answer: Answer) -> None:
        """Keep an answer with a field or colours; those not asked for the longest go."""
        if not _size(answer):
            return
        with self._lock:
            old = self._answers.pop(question, None)
            self._bytes += _size(answer) - (0 if old is None else _size(old))
            self._answers[question] = answer
            while len(self._answers) > (MOST if self._bytes <= self._memory else 1):
                _, gone = self._answers.popitem(last=False)
                self._bytes -= _size(gone)


def _size(answer: Answer) -> int:
    """Bytes of its arrays."""
    return sum(each.nbytes for each in (answer.field, answer.colours, answer.leads_to) if each is not None)
