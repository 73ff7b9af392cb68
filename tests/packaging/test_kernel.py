"""The compiled kernel: by each compiler there is, with what watches over memory, and as a WebAssembly module."""

import ctypes
import os
import platform
import re
import shutil
import subprocess
import sys
import warnings
from importlib.metadata import version
from pathlib import Path

import pytest

from app.main import main
from bihdist_core import SolverError, write_mesh
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.errors import PlainSolverWarning
from bihdist_core.kernel import build, library
from tests.shapes import bumpy

ROOT = Path(__file__).parents[2]
ON_X86 = platform.machine().lower() in ("x86_64", "amd64")
PROCESSOR = Path("/proc/cpuinfo")
COMPILERS = {"gcc": ("gcc",), "clang": ("clang",), "zig": build.ZIG}


def run(*command: str | Path, **options) -> str:
    """What the command prints; the test fails with it if the command does."""
    said = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=ROOT, **options)
    assert said.returncode == 0, said.stdout
    return said.stdout


def found(name: str) -> tuple[str, ...]:
    """The compiler of that name; the test is skipped where it is not there."""
    if name == "zig":
        pytest.importorskip("ziglang")
    elif not shutil.which(name):
        pytest.skip(f"there is no {name}")
    return COMPILERS[name]


# ---------------------------------------------------------------------- the script
@pytest.mark.parametrize("name", COMPILERS)
def test_each_compiler_takes_the_kernel_without_a_warning(name, tmp_path):
    build.build(tmp_path, found(name), build.FAST + build.STRICT)
    names = [f"libbihdist{library.SUFFIX}", f"libbihdist-avx2{library.SUFFIX}"][: 1 + ON_X86]
    assert {path.name for path in tmp_path.iterdir()} == set(names)
    for name in names:
        made = ctypes.CDLL(str(tmp_path / name))
        assert all(hasattr(made, f"bih_{function}") for function in library._SIGNATURES)
        assert not hasattr(made, "add_product")
        if PROCESSOR.exists():
            assert made.bih_has_avx2() == ({"avx2", "fma"} <= set(PROCESSOR.read_text().split()))


@pytest.mark.parametrize(
    ("compiler", "reason"), [("false", "false: it fails"), ("nonesuch", "nonesuch: "), ("gcc --nope", "gcc --nope: ")]
)
def test_a_compiler_that_fails_is_told_in_one_sentence_and_leaves_no_older_library(
    compiler, reason, tmp_path, monkeypatch, capsys
):
    monkeypatch.setenv("CC", compiler)
    older = tmp_path / f"libbihdist{library.SUFFIX}"
    older.touch()
    assert build.main(["--output", str(tmp_path)]) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert f"not compiled, and without it the solver runs in NumPy: {reason}" in said
    assert not older.exists()


def test_no_compiler_at_all_is_told(tmp_path, monkeypatch, capsys):
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(build, "candidates", list)
    assert build.main(["--output", str(tmp_path)]) == 1
    assert "there is no C compiler" in capsys.readouterr().err


# ---------------------------------------------------------------------- which library runs
@pytest.fixture
def kernels(tmp_path, monkeypatch):
    """An empty folder in which the library is looked for."""
    monkeypatch.setattr(library, "FOLDER", tmp_path)
    monkeypatch.delenv(library.PLAIN, raising=False)
    library.library.cache_clear()
    yield tmp_path
    library.library.cache_clear()


def warned() -> str:
    """What is said once where there is no library that can be used."""
    with pytest.warns(PlainSolverWarning) as told:
        assert [library.library() for _ in range(2)] == [None, None]
    (warning,) = told
    return str(warning.message)


def test_without_a_library_there_is_plain_numpy_and_it_is_said_why(kernels):
    why = f"there is no compiled kernel {kernels / 'libbihdist'}{library.SUFFIX}; install bihdist again"
    assert library.description() == f"plain NumPy: {why}"
    assert warned() == f"The solver runs in NumPy, slower, and geodesics by the heat method: {why}."
    with pytest.raises(SolverError, match=re.escape(f"needs the compiled kernel ({why}); use the heat method.")):
        ExactGeodesic(bumpy(60))


def test_beside_the_sources_it_is_said_how_to_compile_them(kernels):
    (kernels / "kernel.h").touch()
    assert library.why_plain().endswith(f"; run python {kernels / 'build.py'}")


def test_what_cannot_be_loaded_is_left_alone_and_the_loader_s_words_are_told(kernels):
    (kernels / f"libbihdist{library.SUFFIX}").write_bytes(b"not a library")
    assert re.search(r"the compiled kernel cannot be loaded \(.*libbihdist.*\w.*\); install", warned())


def test_a_library_of_other_sources_is_left_alone_and_what_it_lacks_is_told(kernels, compiled, monkeypatch):
    shutil.copytree(compiled, kernels, dirs_exist_ok=True)
    monkeypatch.setitem(library._SIGNATURES, "of_tomorrow", (None, ()))
    assert (
        "was built from other sources than this program: it has no bih_of_tomorrow; install bihdist again" in warned()
    )


def test_where_plain_numpy_is_asked_for_nothing_is_said(kernels, monkeypatch):
    monkeypatch.setenv(library.PLAIN, "1")
    assert library.library() is None  # with no warning, which would be an error here
    assert library.description() == "plain NumPy: the environment variable BIHDIST_PLAIN is set"


def test_a_command_says_once_why_the_solver_runs_in_numpy(kernels, tmp_path, capsys):
    mesh, out = tmp_path / "mesh.off", tmp_path / "out"
    words = ["field", str(mesh), "--sources", "3", "--distance", "geodesic", "-o", str(tmp_path / "field.npy")]
    start = "bihdist: The solver runs in NumPy, slower, and geodesics by the heat method: there is no"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PlainSolverWarning)
        write_mesh(mesh, bumpy(60))
        warnings.simplefilter("default", PlainSolverWarning)
        for command in (words, ["batch", str(mesh), "--do", "fields", "--workers", "1", "-o", str(out)]):
            library.library.cache_clear()
            capsys.readouterr()
            assert main(command) == 0
            said = capsys.readouterr().err
            assert said.count(start) == 1
            assert "PlainSolverWarning" not in said


@pytest.fixture(scope="module")
def compiled(tmp_path_factory) -> Path:
    """A folder with the libraries for this machine."""
    folder = tmp_path_factory.mktemp("compiled")
    try:
        build.build(folder, None, build.FAST)
    except build.NotCompiled as reason:
        pytest.skip(str(reason))
    return folder


def test_the_best_library_that_the_processor_runs_is_chosen(kernels, compiled):
    shutil.copytree(compiled, kernels, dirs_exist_ok=True)
    has_avx2 = library.library() is not None and library._loaded("libbihdist").bih_has_avx2()
    assert library.description() == ("compiled, AVX2" if ON_X86 and has_avx2 else "compiled")


def test_a_library_for_avx2_that_cannot_be_loaded_is_passed_over(kernels, compiled):
    shutil.copy(compiled / f"libbihdist{library.SUFFIX}", kernels)
    (kernels / f"libbihdist-avx2{library.SUFFIX}").write_bytes(b"not a library")
    assert library.library() is not None
    assert library.description() == "compiled"


# ---------------------------------------------------------------------- sanitizers
@pytest.fixture(scope="module")
def sanitized(tmp_path_factory) -> tuple[Path, dict[str, str]]:
    """A folder with libraries that gcc's sanitizers watch over, and the environment that they need."""
    runtime = run(*found("gcc"), "-print-file-name=libasan.so").strip()
    if sys.platform != "linux" or not os.path.isabs(runtime):
        pytest.skip("gcc has no address sanitizer here")
    folder = tmp_path_factory.mktemp("sanitized")
    build.build(folder, COMPILERS["gcc"], build.SANITIZED)
    # Python leaves memory to the system when it ends; what it manages by itself would not be watched.
    return folder, {**os.environ, "LD_PRELOAD": runtime, "ASAN_OPTIONS": "detect_leaks=0", "PYTHONMALLOC": "malloc"}


@pytest.mark.parametrize("name", ["libbihdist", "libbihdist-avx2"][: 1 + ON_X86])
def test_sanitizers_find_nothing_on_sound_and_on_mutated_meshes(name, sanitized):
    folder, environment = sanitized
    said = run(sys.executable, "-m", "tests.packaging.mutated_meshes", folder, name, env=environment)
    first, second, third = said.splitlines()
    assert re.fullmatch(r"\d+ of 150 mutated meshes have distances, \d+ of 60 matrices a factor", first)
    assert re.fullmatch(r"\d+ of 150 mutated meshes have Delaunay triangulations", second)
    assert re.fullmatch(r"\d+ of 100 mutated and hard meshes have exact geodesics", third)


OUT_OF_PLACE = """
import ctypes, sys
from pathlib import Path
import numpy as np
from bihdist_core.kernel import library

library.FOLDER = Path(sys.argv[1])
start, index, room = np.arange(301, dtype=np.int32), np.zeros(1, np.int32), np.zeros(100_000, np.uint8)
matrix = ctypes.byref(library.rows_of(start, index))
library._loaded("libbihdist").bih_begin_dissection(matrix, np.zeros((300, 3)), room)
"""
"""A matrix that says it has more entries than there are."""


def test_sanitizers_see_what_is_out_of_place(sanitized):
    folder, environment = sanitized
    command = [sys.executable, "-c", OUT_OF_PLACE, folder]
    said = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment)
    assert said.returncode
    assert "AddressSanitizer: heap-buffer-overflow" in said.stderr


# ---------------------------------------------------------------------- WebAssembly
ZIG_OF_PAGES = "0.17.1"
"""The version of PyPI's ziglang that has compiled the kernel of web pages."""


def test_the_kernel_of_pages_is_what_its_sources_make(tmp_path):
    found("zig")
    if (there := version("ziglang")) != ZIG_OF_PAGES:
        pytest.skip(f"there is ziglang {there}, and {ZIG_OF_PAGES} has compiled the kernel of web pages")
    build.build_wasm(tmp_path)
    assert (tmp_path / "kernel.wasm").read_bytes() == (ROOT / "app/web/kernel.wasm").read_bytes()
