"""How many there are, in words; ids are written without separators, so that they can be pasted where one is typed."""


def counted(count: int, one: str, many: str = "") -> str:
    """Return "1 face", "12,345 faces"."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"
