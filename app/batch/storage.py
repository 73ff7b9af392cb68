"""Folders that results go to: on this computer, or wherever fsspec reaches (`s3://…`, `gs://…`, `memory://…`)."""

import hashlib
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, BinaryIO

from bihdist_core.errors import OutputError, ParameterError
from bihdist_core.file_output import TEMPORARY_NAME, atomic_write, is_stale, lock, temporary_name
from bihdist_core.sentences import shortened


@dataclass(frozen=True)
class Folder:
    """A folder by its path or address, whose files are whole or absent; files are named from it, with `/`.

    Only its address travels to other processes.
    """

    address: str

    def __getstate__(self) -> dict[str, Any]:
        return {"address": self.address}

    @cached_property
    def local(self) -> Path | None:
        """The path on this computer, None if the folder is elsewhere."""
        return None if "://" in self.address else Path(self.address)

    @cached_property
    def _elsewhere(self) -> tuple[Any, str]:
        import fsspec

        try:
            system, root = fsspec.core.url_to_fs(self.address)
            return system, str(root)
        except (ValueError, ImportError) as error:
            # fsspec names the package that is missing.
            raise ParameterError(f"{self.address} cannot be reached: {error}.") from None

    def make(self) -> None:
        """Create the folder; OutputError if that is impossible."""
        try:
            if self.local is not None:
                self.local.mkdir(parents=True, exist_ok=True)
            else:
                system, root = self._elsewhere
                system.makedirs(root, exist_ok=True)
        except OSError as error:
            raise OutputError(f"The folder {self.address} cannot be made: {error.strerror or error}.") from error

    def size(self, name: str) -> int | None:
        """Return the bytes of a file or of all files in a folder, None if there is none."""
        if self.local is not None:
            here = self.local / name
            # os.path, for which a name that is too long is one that is not there.
            if os.path.isdir(here):
                return sum(each.stat().st_size for each in here.rglob("*") if each.is_file())
            return os.path.getsize(here) if os.path.exists(here) else None
        system, root = self._elsewhere
        path = f"{root}/{name}"
        if not system.exists(path):
            return None
        return int(system.du(path)) if system.isdir(path) else int(system.size(path))

    def read(self, name: str) -> bytes | None:
        """Return the content of a file, None if there is none."""
        try:
            if self.local is not None:
                here = self.local / name
                # No folder, and no pipe, which would be waited for.
                return here.read_bytes() if os.path.isfile(here) else None
            system, root = self._elsewhere
            return bytes(system.cat_file(f"{root}/{name}"))
        except (FileNotFoundError, NotADirectoryError):
            return None

    def sha256(self, name: str) -> str:
        """Return the checksum of a file, or of all files in a folder with their names."""
        digest = hashlib.sha256()
        for each, file in self._files(name):
            digest.update(each.encode())
            with file:
                while block := file.read(1 << 20):
                    digest.update(block)
        return digest.hexdigest()

    def _files(self, name: str) -> Iterator[tuple[str, BinaryIO]]:
        """Yield a file without a name, or those in a folder with theirs, in order; each is open, to be closed."""
        if self.local is not None:
            here = self.local / name
            if not here.is_dir():
                yield "", here.open("rb")
                return
            for path in sorted(here.rglob("*")):
                if path.is_file():
                    yield path.relative_to(here).as_posix(), path.open("rb")
            return
        system, root = self._elsewhere
        for each in sorted(system.find(f"{root}/{name}")):
            yield each.partition(f"{root}/{name}")[2].lstrip("/"), system.open(each, "rb")

    def check_free(self, name: str, is_folder: bool = False) -> None:
        """Raise OutputError if a file or folder cannot have this name, or something of another kind has it."""
        if self.local is None:
            return
        path = self.local / name
        try:
            kind = os.stat(path).st_mode
        except (FileNotFoundError, NotADirectoryError):
            return
        except OSError as error:
            reason = error.strerror or error
            raise OutputError(f"{shortened(path.name, 80)} cannot be written ({reason}); rename the mesh.") from None
        if not (stat.S_ISDIR(kind) if is_folder else stat.S_ISREG(kind)):
            there = "a folder" if stat.S_ISDIR(kind) else "a file" if stat.S_ISREG(kind) else "not a regular file"
            raise OutputError(f"{path} is {there}, and a result would have this name; move it.")

    @contextmanager
    def writing(self, name: str) -> Iterator[Path]:
        """Yield a path on this computer that becomes the file when the block ends well; OutputError if it cannot."""
        if self.local is not None:
            (self.local / name).parent.mkdir(parents=True, exist_ok=True)
            # There may be many files; `sweep` looks through all of them once.
            with atomic_write(self.local / name, removes_stale=False) as temporary:
                yield temporary
            return
        system, root = self._elsewhere
        with tempfile.TemporaryDirectory() as scratch:
            here = Path(scratch) / Path(name).name
            yield here
            try:
                system.makedirs(os.path.dirname(f"{root}/{name}"), exist_ok=True)
                # Object stores show a file when all of it is there.
                system.put_file(str(here), f"{root}/{name}")
            except OSError as error:
                raise OutputError(f"{self.address}/{name} could not be written: {error}.") from error

    @contextmanager
    def writing_folder(self, name: str) -> Iterator[str]:
        """Yield the name of a folder that becomes this one when the block ends well; elsewhere, it is this one all
        along."""
        if self.local is None:
            self.remove(name)
            yield name
            return
        begun = temporary_name(self.local / name)
        try:
            begun.mkdir(parents=True)
            # Inside it, for whoever writes a folder may make it anew, and lose what holds it.
            with lock(begun):
                inside = begun / "whole"
                yield str(inside.relative_to(self.local))
                self.remove(name)
                os.replace(inside, self.local / name)
        except OSError as error:
            raise OutputError(f"{self.address}/{name} could not be written: {error.strerror or error}.") from error
        finally:
            shutil.rmtree(begun, ignore_errors=True)

    def sweep(self) -> None:
        """Remove what killed processes have left half written."""
        if self.local is None:
            return  # elsewhere a file is shown when all of it is there
        with suppress(FileNotFoundError):  # another run removes it, too
            for path in list(self.local.rglob(".*")):
                if TEMPORARY_NAME.fullmatch(path.name) and is_stale(path):
                    self.remove(str(path.relative_to(self.local)))

    def write(self, name: str, content: bytes) -> None:
        """Write a file, which is there as a whole or not at all."""
        with self.writing(name) as path:
            path.write_bytes(content)

    def remove(self, name: str) -> None:
        """Remove a file, or a folder with its content, if it is there."""
        if self.local is not None:
            path = self.local / name
            if os.path.isdir(path):
                shutil.rmtree(path, ignore_errors=True)
            elif os.path.lexists(path):
                path.unlink(missing_ok=True)
            return
        system, root = self._elsewhere
        if system.exists(f"{root}/{name}"):
            system.rm(f"{root}/{name}", recursive=True)

    def __str__(self) -> str:
        return self.address
