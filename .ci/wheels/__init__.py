"""The files of a release, built and checked on one machine: `make wheels`.

From the bottom up: `libraries` (what a compiled library says of itself), `contents` (what is in a wheel), `building`
(source distributions and wheels), `trials` (installed in clean environments, where the core's tests run).
"""
