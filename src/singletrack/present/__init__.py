"""Figures, tables and reports: results in, pictures and text out; nothing is computed here."""
