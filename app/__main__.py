"""`python -m app`: the command line from a checkout."""

from .main import main

if __name__ == "__main__":
    raise SystemExit(main())
