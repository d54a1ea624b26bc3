"""The fuzzer is a script beside its modules: they find each other here as they do when it runs."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
