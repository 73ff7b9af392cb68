"""What tests of the program share."""

import pytest


@pytest.fixture
def mesh_file(tmp_path):
    """Writes a surface as an OFF file and gives its path."""

    def write(surface, name="mesh.off"):
        rows = ["OFF", f"{len(surface.vertices)} {len(surface.faces)} 0"]
        rows += [" ".join(map(repr, map(float, v))) for v in surface.vertices]
        rows += [" ".join(map(str, [3, *f])) for f in surface.faces]
        path = tmp_path / name
        path.write_text("\n".join(rows) + "\n")
        return str(path)

    return write
