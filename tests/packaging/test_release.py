"""The files of a release: that they are checked, and that a check fails where something is wrong with them."""

import ast
import runpy
import shutil
import struct
import tomllib
import zipfile
from pathlib import Path

import pytest
from wheels import __main__ as release, building, trials
from wheels.contents import LARGEST, PLATFORMS, complaints
from wheels.libraries import library
from wheels.trials import QUICK, laid_out, of_the_library

from bihdist_core.kernel import library as kernel
from bihdist_core.version import VERSION

ROOT = Path(__file__).resolve().parents[2]
NAMES = b"".join(b"\0bih_%s\0" % name.encode() for name in kernel._SIGNATURES)


# ---------------------------------------------------------------------- what both projects say
def project(folder: str) -> dict:
    return tomllib.loads((ROOT / folder / "pyproject.toml").read_text(encoding="utf-8"))


def test_both_distributions_say_the_same():
    whole, light = project("."), project("bihdist_core")
    for key in ("requires-python", "keywords"):
        assert whole["project"][key] == light["project"][key]
    assert set(light["project"]["dependencies"]) < set(whole["project"]["dependencies"])
    assert set(light["project"]["optional-dependencies"]["batch"]) < set(whole["project"]["dependencies"])
    for extra in ("dask", "zarr"):
        assert light["project"]["optional-dependencies"][extra] == whole["project"]["optional-dependencies"][extra]
    pythons = [{each for each in p["project"]["classifiers"] if ":: Python" in each} for p in (whole, light)]
    assert pythons[0] == pythons[1]
    assert whole["build-system"]["requires"] == light["build-system"]["requires"]
    assert (ROOT / "LICENSE").read_bytes() == (ROOT / "bihdist_core" / "LICENSE").read_bytes()


def test_the_version_is_in_one_place():
    for folder in (".", "bihdist_core"):
        assert project(folder)["project"]["dynamic"] == ["version"]
        assert project(folder)["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "bihdist_core.version.VERSION"}


def test_trials_are_of_tests_that_are_there():
    assert all((ROOT / name).exists() for name in QUICK)


# ---------------------------------------------------------------------- the build backend
@pytest.fixture(scope="module")
def backend():
    return runpy.run_path(str(ROOT / "bihdist_core" / "kernel" / "build_backend.py"))


def test_the_backend_knows_all_platforms(backend):
    assert [*backend["TARGETS"], backend["ANY"]] == [platform.tag for platform in PLATFORMS]


@pytest.mark.parametrize(
    ("folders", "found", "named"),
    [
        (
            {"bihdist": "app", "bihdist_assets": "assets"},
            ["app", "app.new.deep", "apple", "bihdist_core.new"],
            ["apple", "bihdist", "bihdist.new.deep", "bihdist_assets", "bihdist_core.new"],
        ),
        (
            {"bihdist_core": "."},
            ["solver", "new.deep"],
            ["bihdist_core", "bihdist_core.new.deep", "bihdist_core.solver"],
        ),
    ],
)
def test_packages_found_are_named_as_they_are_installed(backend, folders, found, named):
    distribution = backend["Distribution"]({"packages": found, "package_dir": folders})
    for _ in range(2):  # by two commands
        backend["name_packages"](distribution)
        assert distribution.packages == named


def test_zig_is_required_where_another_machine_is_named_or_no_compiler_is_there(backend, monkeypatch):
    required = backend["get_requires_for_build_wheel"]
    lacking = required.__globals__
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setitem(lacking, "_lacks_compiler", lambda: False)
    assert not any("ziglang" in each for each in required({}))
    assert any("ziglang" in each for each in required({"--build-option": "--plat-name=win_amd64"}))
    monkeypatch.setitem(lacking, "_lacks_compiler", lambda: True)
    assert any("ziglang" in each for each in required())
    assert any("ziglang" in each for each in backend["get_requires_for_build_editable"]())


def test_a_compiler_that_is_named_is_taken_though_it_fails(backend, monkeypatch):
    monkeypatch.setenv("CC", "false")
    assert backend["get_requires_for_build_wheel"].__globals__["_lacks_compiler"]() is False


# ---------------------------------------------------------------------- sources and wheels
@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Sources and pure wheels, by the names of the distributions."""
    folder, output = tmp_path_factory.mktemp("sources"), tmp_path_factory.mktemp("dist")
    sources = building.sources(folder, output)
    return {name: (source, building.wheel(source, "any", output)) for name, source in sources.items()}


def test_both_are_built_as_they_should_be(made):
    assert set(made) == set(LARGEST)
    for name, (source, wheel) in made.items():
        assert wheel.name == f"{name}-{VERSION}-py3-none-any.whl"
        assert list(complaints(wheel, source)) == []


def test_the_light_library_is_light(made):
    with zipfile.ZipFile(made["bihdist_core"][1]) as archive:
        assert sum(info.file_size for info in archive.infolist()) + 500_000 < 2 << 20  # with the kernel
        folders = {name.split("/")[1] for name in archive.namelist()}
        (metadata,) = (archive.read(name).decode() for name in archive.namelist() if name.endswith("METADATA"))
    needed = [line for line in metadata.splitlines() if line.startswith("Requires-Dist") and "extra" not in line]
    assert {line.split()[1].partition(">")[0] for line in needed} == {"numpy", "scipy", "threadpoolctl", "lazy-loader"}
    assert "distances" in folders
    assert "experiments" not in folders


def test_sources_have_what_tests_and_builds_them(made):
    whole, light = made["bihdist"][0], made["bihdist_core"][0]
    for name in (
        "Makefile",
        ".ci/set-up",
        ".ci/wheels/__main__.py",
        "tests/conftest.py",
        "bihdist_core/pyproject.toml",
    ):
        assert (whole / name).is_file(), name
    for folder in (whole / "bihdist_core", light):
        assert (folder / "pyproject.toml").is_file()
        names = {path.name for path in (folder / "kernel").iterdir()}
        assert {"kernel.h", "text.c", "build.py", "build_backend.py"} <= names
        assert not list(folder.rglob("libbihdist*"))


def test_trials_of_the_core_need_the_library_alone(made, tmp_path):
    away = laid_out(made["bihdist"][0], tmp_path / "away")
    names = list(of_the_library(away, ("tests/core",)))
    assert set(QUICK) < set(names)
    for name in names:
        found = list(ast.walk(ast.parse((away / name).read_text(encoding="utf-8"))))
        asked = {each.module for each in found if isinstance(each, ast.ImportFrom)}
        asked |= {alias.name for each in found if isinstance(each, ast.Import) for alias in each.names}
        assert not {each.partition(".")[0] for each in asked if each} & {"app", "bihdist"}, name
    assert {path.name for path in away.iterdir()} == {"assets", "pyproject.toml", "tests"}
    assert (away / "assets" / "figure.ply").is_file()


def test_a_trial_fails_where_the_kernel_of_the_wheel_is_not_used(made, tmp_path, monkeypatch):
    said = f"{tmp_path / 'environment' / 'library.py'}\nplain NumPy: libbihdist.so cannot be loaded\n"
    monkeypatch.setattr(trials, "run", lambda command, **options: said)
    with pytest.raises(building.Failed, match=r"manylinux.*\.whl gives this solver: plain NumPy: libbihdist\.so"):
        trials.tried(Path(LINUX), "python3", "lowest", made["bihdist"][0], tmp_path)


def test_an_unknown_platform_is_refused(made, tmp_path):
    with pytest.raises(building.Failed, match=r"Wheels are built for manylinux_2_17_x86_64, .*, any, not for plan9\."):
        building.wheel(made["bihdist_core"][0], "plan9", tmp_path)


def test_a_platform_whose_kernel_is_not_compiled_is_refused(made, tmp_path, monkeypatch):
    source = tmp_path / made["bihdist_core"][0].name
    shutil.copytree(made["bihdist_core"][0], source)
    (source / "kernel" / "broken.c").write_text("#error broken")
    with pytest.raises(building.Failed, match="The wheel for win_amd64 needs the compiled kernel"):
        building.wheel(source, "win_amd64", tmp_path)


def changed(wheel: Path, folder: Path, name: str, change) -> Path:
    """A copy of a wheel under another name, whose files (a dictionary) were changed."""
    with zipfile.ZipFile(wheel) as archive:
        files = {each: archive.read(each) for each in archive.namelist()}
    change(files)
    with zipfile.ZipFile(folder / name, "w") as archive:
        for each, content in files.items():
            archive.writestr(each, content)
    return folder / name


PURE = f"bihdist_core-{VERSION}-py3-none-any.whl"
KERNEL = "bihdist_core/kernel/libbihdist"


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda files: files.pop("bihdist_core/surface.py"), "bihdist_core/surface.py is missing."),
        (lambda files: files.update({"bihdist_core/a.py": b""}), "bihdist_core/a.py is no file of the package."),
        (lambda files: files.update({"tests/a.py": b""}), "It holds bihdist_core, tests in place of bihdist_core."),
        (lambda files: files.update({f"{KERNEL}.so": b"MZ"}), "It holds the libraries libbihdist.so, not none."),
        (lambda files: files.update({"bihdist_core/version.py": bytes(3 << 20)}), " bytes are more than 2,097,152."),
    ],
)
def test_a_wheel_that_is_not_as_it_should_be_is_told(made, tmp_path, change, sentence):
    source, wheel = made["bihdist_core"]
    found = list(complaints(changed(wheel, tmp_path, PURE, change), source))
    assert any(each.endswith(sentence) for each in found), found


def test_a_wheel_without_its_marker_of_types_is_told(made, tmp_path):
    source, wheel = made["bihdist"]
    found = complaints(changed(wheel, tmp_path, wheel.name, lambda files: files.pop("bihdist/py.typed")), source)
    assert "bihdist/py.typed is missing." in list(found)


# ---------------------------------------------------------------------- libraries
def elf(machine: int, glibc: bytes = b"2.17") -> bytes:
    return b"\x7fELF" + bytes(14) + struct.pack("<H", machine) + NAMES + b"\0GLIBC_2.2.5\0GLIBC_%s\0" % glibc


def mach_o(machine: int, version: tuple[int, int], signed: bool = True, command: int = 0x32) -> bytes:
    number = version[0] << 16 | version[1] << 8
    commands = struct.pack("<4I", command, 16, *((1, number) if command == 0x32 else (number, 0))) + (
        struct.pack("<4I", 0x1D, 16, 0, 0) if signed else b""
    )
    return b"\xcf\xfa\xed\xfe" + struct.pack("<7I", machine, 0, 6, 1 + signed, len(commands), 0, 0) + commands + NAMES


def pe(machine: int) -> bytes:
    return b"MZ" + bytes(58) + struct.pack("<I", 64) + b"PE\0\0" + struct.pack("<H", machine) + NAMES


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (elf(62), ("ELF", "x86_64", (2, 17))),
        (elf(183, b"2.4"), ("ELF", "aarch64", (2, 4))),
        (mach_o(0x01000007, (10, 13)), ("Mach-O", "x86_64", (10, 13))),
        (mach_o(0x01000007, (10, 9), signed=False, command=0x24), ("Mach-O", "x86_64", (10, 9))),
        (mach_o(0x0100000C, (11, 0)), ("Mach-O", "arm64", (11, 0))),
        (pe(0x8664), ("PE", "amd64", (0, 0))),
    ],
)
def test_what_libraries_say_of_themselves(content, told):
    found = library(content)
    assert (found.format, found.machine, found.needs) == told
    assert {f"bih_{name}" for name in kernel._SIGNATURES} <= found.names


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"#!/bin/sh\n", "it is no ELF, Mach-O or PE file"),
        (elf(62)[:18], "it ends in its headers"),
        (elf(40), "it is for machine 0x28, not for x86_64 or aarch64"),
        (pe(0xAA64), "it is for machine 0xaa64, not for amd64"),
        (mach_o(0x0100000C, (11, 0), signed=False), "it has no signature"),
        (mach_o(0x01000007, (11, 0), command=0x1B), "it does not say which macOS it needs"),
    ],
)
def test_what_is_no_library_of_ours_is_refused(content, reason):
    with pytest.raises(ValueError, match=reason):
        library(content)


def test_the_library_of_this_machine_is_read():
    for path in kernel.FOLDER.glob("libbihdist*"):
        assert {f"bih_{name}" for name in kernel._SIGNATURES} <= library(path.read_bytes()).names


LINUX = f"bihdist_core-{VERSION}-py3-none-manylinux_2_17_aarch64.whl"


@pytest.mark.parametrize(
    ("content", "sentences"),
    [
        (elf(183), ["Its tags are py3-none-any, and its name has py3-none-manylinux_2_17_aarch64."]),
        (elf(62), ["libbihdist.so is ELF for x86_64, not ELF for aarch64."]),
        (elf(183, b"2.34"), ["libbihdist.so needs version 2.34 of the system."]),
        (elf(183).replace(b"bih_cut\0", b"bih_cup\0"), ["libbihdist.so lacks bih_cut."]),
        (b"", ["libbihdist.so cannot be used: it is no ELF, Mach-O or PE file."]),
    ],
)
def test_a_kernel_that_is_not_that_of_the_platform_is_told(made, tmp_path, content, sentences):
    source, wheel = made["bihdist_core"]
    path = changed(wheel, tmp_path, LINUX, lambda files: files.update({f"{KERNEL}.so": content}))
    assert set(sentences) <= set(complaints(path, source))


def test_a_platform_that_is_none_of_ours_is_told(made, tmp_path):
    source, wheel = made["bihdist_core"]
    path = changed(wheel, tmp_path, LINUX.replace("manylinux_2_17_aarch64", "linux_x86_64"), lambda files: None)
    assert "linux_x86_64 is no platform of ours." in list(complaints(path, source))


def test_a_release_without_the_guide_is_refused_and_leaves_the_last_one(tmp_path, monkeypatch, capsys):
    (tmp_path / "bihdist-0.1.whl").touch()
    monkeypatch.setattr(release, "ROOT", tmp_path)
    monkeypatch.setattr("sys.argv", ["wheels", "--output", str(tmp_path)])
    with pytest.raises(SystemExit):
        release.main()
    assert "`make guide` makes it" in capsys.readouterr().err
    assert (tmp_path / "bihdist-0.1.whl").exists()
