"""The command line, one module for each household of commands."""
