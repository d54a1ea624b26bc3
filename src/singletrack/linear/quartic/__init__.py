"""Roots of many quartics at once."""
