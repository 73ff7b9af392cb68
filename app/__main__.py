"""`python -m app`: the command line from a checkout."""

from .program import run

if __name__ == "__main__":
    raise SystemExit(run())
