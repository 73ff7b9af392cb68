"""`python -m tests.qt.restored SESSION PICTURE`: opens a session in a new window, and writes what it shows.

The picture is that of the whole window.  Prints the document as JSON: as it is, and after a step and its undoing.
"""

import json
import os
import sys
from pathlib import Path

from tests.qt.parts import parts

from .hands import Hands


def main() -> None:
    session, picture = sys.argv[1], sys.argv[2]
    hands = Hands(1, Path(picture).parent)
    window, wanted = hands.window, [int(side) for side in os.environ["WINDOW_SIZE"].split("x")]
    window.resize(*wanted)
    hands.spin(0.2)
    parts(window).session_file.open(session)
    hands.until(lambda: window.session.loaded() is not None and not window.session.is_opening)
    rested(hands)
    window.grab().save(picture)
    shown = [written(window)]
    parts(window).choices.choose(window.session.document.panels[0].id, window.session.document.panels[1].shows)
    hands.settle()
    shown.append(written(window))
    window.session.undo()
    rested(hands)
    shown.append(written(window))
    print(json.dumps({"documents": shown, "errors": hands.errors}), flush=True)
    os._exit(0)


def rested(hands: Hands) -> None:
    """All that instruments find out in the background is there."""
    hands.settle()
    hands.spin(1.0)
    hands.settle()


def written(window) -> dict:
    from app.document.form import document_data

    return document_data(parts(window).session_file.recipe().document)


if __name__ == "__main__":
    main()
