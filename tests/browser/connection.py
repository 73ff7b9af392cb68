"""Commands and events of a browser, as JSON through a WebSocket: what its two protocols have in common."""

import json
import socket

import websocket

LIMIT = 120
"""Seconds after which a browser that says nothing is given up."""


class BrowserError(Exception):
    """What a browser answers that it cannot do, or that a script in it has failed with."""


class Connection:
    """One WebSocket; `call` waits for the answer, and events that come meanwhile are kept in `events`."""

    def __init__(self, url: str, through: socket.socket):
        # Both browsers refuse who says where it comes from.
        self._socket = websocket.create_connection(url, socket=through, suppress_origin=True)
        self._socket.settimeout(LIMIT)
        self._asked = 0
        self.events: list[dict] = []

    def call(self, method: str, parameters: dict, **beside: str) -> dict:
        """The result of a command; BrowserError if it says that it failed.  beside: such as the session's id."""
        self._asked += 1
        self._socket.send(json.dumps({"id": self._asked, "method": method, "params": parameters, **beside}))
        while True:
            message = json.loads(self._socket.recv())
            if "method" in message:
                self.events.append(message)
            elif message.get("id") == self._asked:
                if "error" in message:
                    raise BrowserError(f"{method}: {_words_of(message)}")
                return message["result"]

    def close(self) -> None:
        self._socket.close()


def _words_of(message: dict) -> str:
    """Chromium has the sentence in the error, Firefox beside it."""
    error = message["error"]
    return error["message"] if isinstance(error, dict) else f"{error}, {message.get('message')}"
