"""Sweeps: many designs and speeds, from a study file to a labelled store on disk, in stretches that outlive a stop."""

from singletrack.sweep.run import Summary, run_sweep
from singletrack.sweep.store import open_sweep
from singletrack.sweep.study import Study, load_study

__all__ = ["Study", "Summary", "load_study", "open_sweep", "run_sweep"]
