"""The paper, start to finish: Schwab and Kooijman, Lateral dynamics of a bicycle with passive rider model."""

from singletrack.reproduce.run import reproduce

__all__ = ["reproduce"]
