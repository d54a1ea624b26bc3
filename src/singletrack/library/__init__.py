"""What comes with the package, and loading by name or path."""

from singletrack.library.load import descriptions, load_bicycle, load_rider, shipped

__all__ = ["descriptions", "load_bicycle", "load_rider", "shipped"]
