"""Can the rider control it, and how hard is it: controllability, effort, feedback, responses, measured weave."""
