"""What a refusal has to be: one sentence that names what is refused."""

LONGEST = 1000
NO_MEMORY = ("too large for the memory", "not enough memory")
"""What is said of a file of a few kilobytes where a reader believes the number in it."""


def fault_of(message: str, name: str = "") -> str:
    """What is wrong with the message of a refusal, nothing if all is well; name: what it has to hold."""
    shown = message if len(message) < 200 else f"{message[:200]}..."
    if not message.strip():
        return "a refusal without a word"
    if len(message.strip().splitlines()) > 1:
        return f"a refusal of several lines: {shown!r}"
    if len(message) > LONGEST:
        return f"a refusal of {len(message)} characters: {shown!r}"
    if name not in message:
        return f"a refusal that does not name {name}: {shown!r}"
    if any(words in message for words in NO_MEMORY):
        return f"a small file that asks for all memory: {shown!r}"
    return "" if message.rstrip().endswith((".", "?", ")")) else f"a refusal that is no sentence: {shown!r}"
