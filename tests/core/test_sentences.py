"""Messages are one line of bounded length, whatever they repeat."""

import pickle

import pytest

from bihdist_core import BihdistError, NotEnoughMemory, OutputError, ParameterError
from bihdist_core.sentences import LONGEST, LONGEST_WORD, one_line, shortened


def test_a_short_text_stays_and_a_long_one_loses_its_middle():
    assert shortened("abcdefghij", 10) == "abcdefghij"
    assert shortened("abcdefghijk", 10) == "abcde...jk"
    assert all(len(shortened("x" * 100, most)) == most for most in range(4, 100))


def test_a_message_is_one_line():
    assert one_line("a\nb\r\n\tc\x1b[1m\u2028d ") == "a b c [1m d"
    path = "/" + "x" * (LONGEST_WORD - 1)
    assert one_line(f"{path} is  missing.") == f"{path} is  missing."


@pytest.mark.parametrize("kind", [BihdistError, ParameterError, OutputError, NotEnoughMemory])
def test_errors_say_no_more(kind):
    error = kind(f"No {'x' * 3000} in\n{'a b ' * 500}; rename it.")
    assert len(str(error)) <= LONGEST
    assert "\n" not in str(error)
    assert str(error).startswith("No xxx")
    assert str(error).endswith("; rename it.")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
