"""The bicycle and its rider as a machine of the engine."""
