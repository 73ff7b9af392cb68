"""Browsers for the tests of web pages; skipped, and said so, where one is not installed."""

import pytest

from .chromium import Chromium
from .firefox import Firefox


@pytest.fixture(scope="session", params=[Chromium, Firefox], ids=lambda kind: kind.NAME)
def running_browser(request):
    if request.param.program() is None:
        pytest.skip(f"{request.param.NAME} is not installed; .ci/set-up dev installs it where there is apt-get.")
    browser = request.param()
    yield browser
    browser.close()


@pytest.fixture
def browser(running_browser):
    """Each browser in turn, at an empty page of 1280 by 720, light, with nothing told of what was before."""
    running_browser.open("about:blank")
    running_browser.size(1280, 720)
    running_browser.dark(False)
    running_browser.forget()
    return running_browser
