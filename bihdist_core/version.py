"""Which version this is: the one place that says it, for the library and for all that is built on it."""

VERSION = "0.2.0rc1"
