"""The results of a run in a folder, a line of JSON for each block of cases, so that an interrupted run goes on."""

import json
from collections.abc import Iterator
from datetime import date
from pathlib import Path
from threading import Lock

from .outcome import Tally

FILE = "results.jsonl"


class Log:
    """What is done; a line that an interruption has cut off counts as not there."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.path, self._lock = folder / FILE, Lock()
        self.tallies: dict[tuple[str, int], Tally] = {}
        self.days: set[str] = set()
        for line in self._lines():
            self.tallies[line["part"], line["seed"]] = Tally.from_json(line)
            self.days.add(line["day"])

    def add(self, part: str, seed: int, tally: Tally) -> None:
        """Keep the outcomes of a block."""
        day = date.today().isoformat()
        line = {"part": part, "seed": seed, "day": day, **tally.as_json()}
        with self._lock:
            self.tallies[part, seed] = tally
            self.days.add(day)
            cut_off = self.path.exists() and not self.path.read_bytes().endswith(b"\n")
            with self.path.open("a", encoding="utf-8") as file:
                file.write(("\n" if cut_off else "") + json.dumps(line) + "\n")

    def of(self, part: str) -> Tally:
        """All outcomes of a part; faults have the seed of their block before their number."""
        whole = Tally()
        for (name, seed), tally in sorted(self.tallies.items()):
            if name == part:
                faults = [[seed, *fault] for fault in tally.faults]
                whole.join(Tally.from_json({**tally.as_json(), "faults": faults}))
        return whole

    def _lines(self) -> Iterator[dict]:
        for text in self.path.read_text(encoding="utf-8").splitlines() if self.path.exists() else []:
            try:
                yield json.loads(text)
            except ValueError:
                continue
