"""Lateral dynamics of bicycles with real riders, hands on the handlebar."""

__version__ = "0.1.0"
