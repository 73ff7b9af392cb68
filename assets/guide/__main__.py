"""`python -m assets.guide`, which is `make guide`: pages in app/guide, for `bihdist guide` and the wheel."""

from .building.build import main

if __name__ == "__main__":
    raise SystemExit(main())
