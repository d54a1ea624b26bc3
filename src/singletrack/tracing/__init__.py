"""Programs traced: an array function of parameters as one straight list of scalar statements."""

from singletrack.tracing.graph import Graph, Node
from singletrack.tracing.interpret import trace
from singletrack.tracing.write import javascript_function, python_function, python_program

__all__ = ["Graph", "Node", "javascript_function", "python_function", "python_program", "trace"]
