"""Files: reading and writing our own format and those of other tools of this field."""
