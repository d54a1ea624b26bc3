"""The page in the browser: sliders, a rider in motion, eigenvalues, in one file.

The room is not called ``page``, because ``singletrack.page`` is the function that makes one.
"""

from singletrack.webpage.page import Page, page

__all__ = ["Page", "page"]
