"""Instruments: what measures, each in a dock of the window."""
