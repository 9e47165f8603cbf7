"""Time spent in each stage of a run."""

from time import perf_counter


class Clock:
    """Adds up wall-clock seconds by stage; a lap is the time since the last one."""

    def __init__(self):
        self.seconds = {}
        self._last = perf_counter()

    def begin(self):
        """Start the first lap."""
        self._last = perf_counter()

    def lap(self, stage):
        """Count the time since the last lap for `stage`."""
        now = perf_counter()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._last
        self._last = now

    def leave_out(self, seconds):
        """Count that much less for the stage that is going on."""
        self._last += seconds
