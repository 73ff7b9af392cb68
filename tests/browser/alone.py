"""Runs a program in a network namespace of its own, and lets connections to it in through a Unix socket.

    unshare --user --map-root-user --net python alone.py SOCKET COMMAND...

The namespace has the loopback device and nothing else, so the program reaches no other machine, and no server on this
one.  Whoever connects to SOCKET says a port in one line and is connected with that port inside.
"""

import fcntl
import socket
import struct
import subprocess
import sys
import threading

GET_FLAGS, SET_FLAGS, UP = 0x8913, 0x8914, 1
"""SIOCGIFFLAGS, SIOCSIFFLAGS and IFF_UP of Linux."""


def main(path: str, command: list[str]) -> int:
    _raise_loopback()
    door = socket.socket(socket.AF_UNIX)
    door.bind(path)
    door.listen()
    program = subprocess.Popen(command, stdin=subprocess.DEVNULL)
    threading.Thread(target=_let_in, args=(door,), daemon=True).start()
    return program.wait()


def _raise_loopback() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        request = struct.pack("16sh", b"lo", 0)
        flags = struct.unpack("16sh", fcntl.ioctl(any_socket, GET_FLAGS, request))[1]
        fcntl.ioctl(any_socket, SET_FLAGS, struct.pack("16sh", b"lo", flags | UP))


def _let_in(door: socket.socket) -> None:
    while True:
        outer, _ = door.accept()
        port = b""
        while not port.endswith(b"\n"):
            port += outer.recv(1)
        inner = socket.create_connection(("127.0.0.1", int(port)))
        for one, other in ((outer, inner), (inner, outer)):
            threading.Thread(target=_copy, args=(one, other), daemon=True).start()


def _copy(one: socket.socket, other: socket.socket) -> None:
    try:
        while data := one.recv(1 << 16):
            other.sendall(data)
        other.shutdown(socket.SHUT_WR)
    except OSError:
        pass  # the program has ended


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
