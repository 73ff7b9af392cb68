"""Compile the kernel: a library for every processor of a kind and, on x86-64, another for those with AVX2 and FMA.

    python bihdist_core/kernel/build.py

The compiler is what the environment variable CC names, else `cc`, `gcc` or `clang`, else zig where PyPI's `ziglang` is
installed.  Nothing but the standard library is needed: `build_backend.py` runs this where nothing is installed yet.
"""

import argparse
import ctypes
import importlib.util
import os
import platform
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

HERE = Path(__file__).resolve().parent
NAME = "libbihdist"
ZIG = (sys.executable, "-m", "ziglang", "cc")

LANGUAGE = ("-std=c11", "-fno-math-errno", "-ffp-contract=fast", "-fvisibility=hidden")
FAST = ("-O3",)
AVX2 = ("-mavx2", "-mfma", "-DLANES=4")
STRICT = ("-Wall", "-Wextra", "-Werror")
SANITIZED = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")
# Unrolled and vectorized by the compiler, the module would be half as large again, and no faster.
WASM = (
    "-O2", "-fno-unroll-loops", "-fno-vectorize", "-target", "wasm32-freestanding",
    "-mcpu=generic+simd128+bulk_memory", "-nostdlib", "-s", "-fno-sanitize=all", "-Wl,--no-entry",
    "-Wl,-z,stack-size=1048576",
)  # fmt: skip

Command = tuple[str, ...]


class NotCompiled(Exception):
    """The library could not be built."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Compile what the arguments say; if that fails, say so in one sentence, and the exit status is 1."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=HERE, metavar="FOLDER", help="by default where it is looked for")
    parser.add_argument("--target", help="another kind of machine, by zig: aarch64-macos, x86_64-linux-gnu.2.17")
    parser.add_argument("--wasm", action="store_true", help="kernel.wasm, which web pages have, by zig")
    parser.add_argument("--sanitize", action="store_true", help="with the address and undefined behavior sanitizers")
    parser.add_argument("--strict", action="store_true", help="warnings are errors")
    parser.add_argument("--check", action="store_true", help="only try, strictly, each compiler there is")
    options = parser.parse_args(arguments)
    flags = (SANITIZED if options.sanitize else FAST) + (STRICT if options.strict else ())
    try:
        if options.check:
            check()
        elif options.wasm:
            build_wasm(options.output)
        else:
            build(options.output, ZIG if options.target else None, flags, options.target)
    except (NotCompiled, OSError) as error:
        print(f"The solver's kernel is not compiled, and without it the solver runs in NumPy: {error}", file=sys.stderr)
        return 1
    return 0


def build(folder: Path, command: Command | None, flags: Command, target: str | None = None) -> None:
    """Make the libraries in a folder, by the first compiler that works if command is None.

    If that fails (NotCompiled), older ones are gone, too: they would not fit any more.
    """
    made: dict[str, Command] = {f"{NAME}{suffix(target)}": ()}
    if (target or platform.machine()).lower().startswith(("x86_64", "amd64")):
        made[f"{NAME}-avx2{suffix(target)}"] = AVX2
    with TemporaryDirectory() as work, ThreadPoolExecutor() as pool:
        try:
            command = command or compiler()
            options = [*LANGUAGE, *flags, *machine(command, target), *map(str, sorted(HERE.glob("*.c")))]
            list(pool.map(lambda name: call(command, *options, *made[name], "-o", f"{work}/{name}"), made))
        finally:
            for name in made:
                (folder / name).unlink(missing_ok=True)
        for name in made:
            shutil.copyfile(f"{work}/{name}", folder / name)


def build_wasm(folder: Path) -> None:
    """Make the WebAssembly module in a folder: it has what `page.c` exports, and imports nothing."""
    call(ZIG, *LANGUAGE, *WASM, *STRICT, *map(str, sorted(HERE.glob("*.c"))), "-o", str(folder / "kernel.wasm"))


def check() -> None:
    """Compile with each compiler there is, warnings as errors, and keep nothing."""
    for command in candidates():
        print("The kernel by", shlex.join(command))
        with TemporaryDirectory() as folder:
            build(Path(folder), command, FAST + STRICT)


def candidates() -> list[Command]:
    """Return the commands of compilers that there are; CC, if set, is the only one."""
    if os.environ.get("CC"):
        return [tuple(shlex.split(os.environ["CC"], posix=os.name != "nt"))]
    # Commonly `cc` is another name of one of the others.
    found = {os.path.realpath(path): (name,) for name in ("clang", "gcc", "cc") if (path := shutil.which(name))}
    return [*reversed(found.values()), *([ZIG] if importlib.util.find_spec("ziglang") else [])]


def compiler() -> Command:
    """Return the first compiler that makes a library which this Python can load, or NotCompiled."""
    reason = "there is no C compiler, nor PyPI's ziglang."
    for command in candidates():
        # Windows keeps the file of a library that is loaded.
        with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            library = f"{folder}/try{suffix()}"
            try:
                call(command, *LANGUAGE, *machine(command), str(HERE / "processor.c"), "-o", library)
                ctypes.CDLL(library)
                return command
            except (NotCompiled, OSError) as error:
                reason = str(error)
    raise NotCompiled(reason)


def call(command: Command, *options: str) -> None:
    """Run a compiler; NotCompiled with the first error it tells."""
    try:
        said = subprocess.run(
            [*command, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
        )
    except OSError as error:
        raise NotCompiled(f"{shlex.join(command)}: {error}") from error
    if said.returncode:
        lines = said.stdout.splitlines() or ["it fails without a message"]
        raise NotCompiled(f"{shlex.join(command)}: {next((line for line in lines if 'error' in line), lines[-1])}")


def machine(command: Command, target: str | None = None) -> list[str]:
    """Options for a library that runs on every processor of a kind: that of this machine, or zig's target."""
    options = ["-shared"] if suffix(target) == ".dll" else ["-shared", "-fPIC"]
    if any(Path(word).stem in ("zig", "ziglang") for word in command):
        # Without them zig compiles for this very processor, and adds what debuggers want.
        options += ["-target", target] if target else ["-mcpu=baseline"]
        options += ["-s", "-fno-sanitize=all"]
    elif sys.platform == "darwin":
        options += ["-arch", platform.machine()]
    return options


def suffix(target: str | None = None) -> str:
    """Return the ending of library names."""
    system = target or sys.platform
    if "macos" in system or "darwin" in system:
        return ".dylib"
    return ".dll" if "win" in system else ".so"


if __name__ == "__main__":
    raise SystemExit(main())
