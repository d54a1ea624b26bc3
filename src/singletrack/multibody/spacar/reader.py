"""One statement after the other, checked as it is read into a description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.multibody.spacar.description import Description

if TYPE_CHECKING:
    from singletrack.multibody.spacar.statements import Source, Statement

__all__ = ["NODES", "Reader"]

LARGEST = 99_999

#: Kinds of nodes in words.
NODES = {
    "p2": "a position in the plane",
    "o2": "an angle in the plane",
    "p3": "a position in space",
    "o3": "an orientation in space",
}


class Reader:
    """One statement being read into a description."""

    def __init__(self, source: Source) -> None:
        self.description = Description(source.where, source.dialect)
        self.source = source
        self.statement: Statement = source.statements[0]
        self.numbers = self.statement.numbers

    def refuse(self, reason: str) -> InputError:
        """Return the error that names file, line, keyword and reason."""
        return InputError(f"{self.source.where}, line {self.statement.line}: {self.statement.keyword}: {reason}")

    def remark(self, text: str) -> None:
        """Note what has no effect.

        Parameters
        ----------
        text : str
            What, and why.
        """
        place = f"{self.source.where}, line {self.statement.line}: {self.statement.keyword}"
        self.description.remarks.append(f"{place}: {text}")

    def count(self, least: int, most: int, wanted: str) -> None:
        """Check how many numbers there are.

        Parameters
        ----------
        least, most : int
            How many there may be.
        wanted : str
            What they are, for a message.
        """
        if not least <= len(self.numbers) <= most:
            raise self.refuse(f"found {len(self.numbers)} numbers, must have {wanted}")

    def whole(self, index: int, what: str) -> int:
        """Return a positive whole number.

        Parameters
        ----------
        index : int
            Which of the statement's numbers.
        what : str
            What it is, for a message.
        """
        if index >= len(self.numbers):
            raise self.refuse(f"found {len(self.numbers)} numbers, must have more: {what} is missing")
        value = self.numbers[index]
        if value != int(value) or not 1 <= value <= LARGEST:
            raise self.refuse(f"{what} is {value:g}, must be a whole number from 1 to {LARGEST}")
        return int(value)

    def element(self) -> int:
        """Return the number of a known element, the first of the numbers."""
        number = self.whole(0, "element")
        if number not in self.description.elements:
            raise self.refuse(f"there is no element {number}")
        return number

    def node(self, index: int = 0) -> int:
        """Return the number of a known node.

        Parameters
        ----------
        index : int
            Which of the statement's numbers it is.
        """
        number = self.whole(index, "node")
        if number not in self.description.nodes:
            raise self.refuse(f"no element names node {number}")
        return number

    def component(self, index: int, most: int, what: str) -> int:
        """Return a component of an element or node.

        Parameters
        ----------
        index : int
            Which of the statement's numbers it is.
        most : int
            The number of components.
        what : str
            Of what, for a message.
        """
        component = self.whole(index, "component")
        if component > most:
            raise self.refuse(f"{what} has {most} components, found {component}")
        return component

    def element_keys(self) -> list[tuple[int, int]]:
        """Return element and components: those given, or all."""
        self.count(1, 13, "an element and, if not all, its components")
        number = self.element()
        most = self.description.components(number)
        given = [self.component(i, most, f"element {number}") for i in range(1, len(self.numbers))]
        return [(number, i) for i in given or range(1, most + 1)]

    def node_keys(self) -> list[tuple[int, int]]:
        """Return node and components: those given, or all."""
        self.count(1, 5, "a node and, if not all, its coordinates")
        number = self.node()
        most = self.description.width(number)
        given = [self.component(i, most, f"node {number}") for i in range(1, len(self.numbers))]
        return [(number, i) for i in given or range(1, most + 1)]

    def not_negative(self, values: tuple[float, ...], what: str) -> tuple[float, ...]:
        """Check that none of the values is negative.

        Parameters
        ----------
        values : tuple of float
        what : str
            What they are, for a message.
        """
        if min(values) < 0.0:
            raise self.refuse(f"{what} is {min(values):g}, must not be negative")
        return values
