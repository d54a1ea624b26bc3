"""The command line: a module for each command, and the door that opens them when they are asked for."""
