"""How a command is refused: by one sentence, and exit status 2."""

from app.main import main


def refused(capsys, *arguments):
    """The sentence a refused command prints."""
    assert main([str(a) for a in arguments]) == 2
    *notes, said = capsys.readouterr().err.splitlines(keepends=True)
    assert not any(note.startswith("bihdist: ") for note in notes)
    assert said.startswith("bihdist: ")
    assert "Traceback" not in said
    return said
