"""Sweeps: many designs and speeds, from a study file to a labelled store on disk, in chunks that outlive a stop."""

from singletrack.sweep.reading import check_sweep, designs_to_dicts, open_sweep
from singletrack.sweep.run import Summary, run_sweep
from singletrack.sweep.study import Study, load_study

__all__ = ["Study", "Summary", "check_sweep", "designs_to_dicts", "load_study", "open_sweep", "run_sweep"]
