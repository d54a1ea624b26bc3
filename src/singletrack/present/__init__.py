"""Figures, tables and reports, drawn from result objects."""
