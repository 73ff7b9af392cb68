"""A file is written whole or not at all."""

import errno
import os
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from bihdist_core import file_output as module
from bihdist_core.errors import OutputError
from bihdist_core.file_output import atomic_write, check_output, check_outputs, remove_stale


def test_a_new_file_and_a_replaced_one(tmp_path):
    path = tmp_path / "a.txt"
    for text in ("new", "newer"):
        with atomic_write(path) as temporary:
            assert temporary.parent == path.parent
            assert temporary.suffix == ".txt"
            temporary.write_text(text)
        assert path.read_text() == text
    assert os.listdir(tmp_path) == ["a.txt"]


@pytest.mark.parametrize("reason", [KeyboardInterrupt, ZeroDivisionError])
def test_the_old_file_stays_when_writing_fails(tmp_path, reason):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def write_a_part():
        with atomic_write(path) as temporary:
            temporary.write_text("ne")
            raise reason

    with pytest.raises(reason):
        write_a_part()
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_a_full_disk_is_an_output_error(tmp_path):
    def write_a_part():
        with atomic_write(tmp_path / "a.txt") as temporary:
            temporary.write_text("part")
            raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(OutputError, match=r"a\.txt could not be written: No space left on device\."):
        write_a_part()
    assert not os.listdir(tmp_path)


def test_no_new_file_appears_while_the_block_runs(tmp_path):
    with atomic_write(tmp_path / "a.txt") as temporary:
        temporary.write_text("x")
        assert not (tmp_path / "a.txt").exists()


def test_a_link_is_followed_and_permissions_are_kept(tmp_path):
    target, link = tmp_path / "target.txt", tmp_path / "link.txt"
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(target)
    with atomic_write(link) as temporary:
        temporary.write_text("new")
    assert link.is_symlink()
    assert target.read_text() == "new"
    assert target.stat().st_mode & 0o777 == 0o640


def test_a_new_file_has_the_usual_permissions(tmp_path):
    (tmp_path / "usual").write_text("")
    with atomic_write(tmp_path / "a.txt") as temporary:
        temporary.write_text("x")
    assert (tmp_path / "a.txt").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_places_that_cannot_be_written(tmp_path, monkeypatch):
    (tmp_path / "folder.txt").mkdir()
    (tmp_path / "file").write_text("")
    os.mkfifo(tmp_path / "pipe.txt")
    for path, expected in [
        (tmp_path / "none" / "a.txt", "there is no folder"),
        (tmp_path / "folder.txt", "is a folder"),
        (tmp_path / "file" / "a.txt", "is not a folder"),
        (tmp_path / "pipe.txt", "is not a regular file"),
        (tmp_path / "a\0.txt", "zero bytes"),
    ]:
        with pytest.raises(OutputError, match=expected), atomic_write(path):
            pytest.fail("the block must not run")
        with pytest.raises(OutputError, match=expected):
            check_output(path, [".txt"])
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(OutputError, match="permission denied"):
        check_output(tmp_path / "a.txt", [".txt"])


def test_every_output_that_is_named_is_checked(tmp_path):
    assert not check_outputs((None, (".csv",)), ("", (".obj",)))
    assert check_outputs((None, (".csv",)), (tmp_path / "a.OBJ", (".obj",)))
    with pytest.raises(OutputError, match=r"this can be written as \.npy, \.txt"):
        check_outputs((tmp_path / "a.csv", (".csv",)), (tmp_path / "a.obj", (".npy", ".txt")))


WRITES = """
import sys
from pathlib import Path
from bihdist_core.file_output import atomic_write
k = 0
while True:
    k += 1
    with atomic_write(sys.argv[1]) as temporary:
        temporary.write_text(f"{k % 10}" * 1_000_000)
    if k == 1:
        print("begun", flush=True)
"""


def test_whoever_is_killed_leaves_a_whole_file(tmp_path):
    path = tmp_path / "a.txt"
    for after in (0.0, 0.003, 0.01, 0.017):
        process = subprocess.Popen([sys.executable, "-c", WRITES, str(path)], stdout=subprocess.PIPE)
        process.stdout.readline()
        time.sleep(after)
        process.kill()
        process.communicate()
        text = path.read_text()
        assert text == text[0] * 1_000_000


HOLDS = """
import sys
from bihdist_core.file_output import atomic_write
with atomic_write(sys.argv[1]) as temporary:
    temporary.write_text("half")
    print(temporary.name, flush=True)
    sys.stdin.read()
"""


def test_the_next_write_of_a_name_sweeps_what_dead_processes_have_left_and_nothing_of_live_ones(tmp_path):
    path = tmp_path / "a.b.txt"
    mine = [".a.b-01234567.txt", ".a.b.half-0123.txt", "a.b.half-01234567.txt", ".other.half-01234567.txt"]
    for name in mine:
        (tmp_path / name).write_text("mine")
    (tmp_path / ".a.b.half-01234567.txt").mkdir()
    os.symlink("/etc/hostname", tmp_path / ".a.b.half-12345678.txt")
    mine += [".a.b.half-01234567.txt", ".a.b.half-12345678.txt"]
    command = [sys.executable, "-c", HOLDS, str(path)]
    live, dead = (subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) for _ in range(2))
    names = [process.stdout.readline().strip() for process in (live, dead)]
    dead.kill()
    dead.communicate()
    assert {*names} <= {*os.listdir(tmp_path)}
    with atomic_write(path) as temporary:
        temporary.write_text("new")
    assert sorted(os.listdir(tmp_path)) == sorted(["a.b.txt", names[0], *mine])
    live.communicate("")
    assert live.returncode == 0
    assert path.read_text() == "half"
    assert sorted(os.listdir(tmp_path)) == sorted(["a.b.txt", *mine])


def test_what_is_swept_between_its_making_and_its_lock_is_made_anew(tmp_path, monkeypatch):
    made, lock = [], module.lock

    def swept_at_first(path):
        made.append(path)
        if len(made) == 1:
            path.unlink()
        return lock(path)

    monkeypatch.setattr(module, "lock", swept_at_first)
    with atomic_write(tmp_path / "a.txt") as temporary:
        temporary.write_text("x")
    assert len(made) == 2
    assert os.listdir(tmp_path) == ["a.txt"]


def test_where_there_are_no_locks_age_tells(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    old, young = tmp_path / ".a.half-01234567.txt", tmp_path / ".a.half-89abcdef.txt"
    for locks in (None, SimpleNamespace(flock=refuse, LOCK_EX=2, LOCK_NB=4)):
        monkeypatch.setattr(module, "fcntl", locks)
        old.write_text("x")
        young.write_text("x")
        os.utime(old, (1, 1))
        with atomic_write(tmp_path / "a.txt") as temporary:
            temporary.write_text("x")
        assert sorted(os.listdir(tmp_path)) == [young.name, "a.txt"]


def test_a_folder_of_the_programs_own_is_swept(tmp_path):
    for name in (".a.half-01234567.json", ".b.half-89abcdef.json", "c.json"):
        (tmp_path / name).write_text("{")
    remove_stale(tmp_path)
    assert os.listdir(tmp_path) == ["c.json"]
    remove_stale(tmp_path / "none")
