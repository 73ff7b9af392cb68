"""Commands that tests run in their own process."""

from app.main import main


def ran(capsys, *words, status=0):
    """Run a command that ends with a status, and return what it has said: `out` and `err`."""
    capsys.readouterr()  # what was said before
    assert main([*map(str, words)]) == status
    return capsys.readouterr()


def refused(capsys, *words):
    """Run a command that is refused, and return the one sentence that says so."""
    *notes, said = ran(capsys, *words, status=2).err.splitlines(keepends=True)
    assert not any(note.startswith("bihdist: ") for note in notes)
    assert said.startswith("bihdist: ")
    assert "Traceback" not in said
    return said.strip()
