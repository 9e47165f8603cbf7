"""The line on a terminal that shows how far a run is, also while a step takes long."""

REFRESH = 0.2  # s between updates

COLUMNS = (
    (0, "step {task.fields[step]}"),
    (60, "t = {task.fields[time]:.4g} s"),
    (0, None),  # the bar takes the room that is left
    (0, "{task.percentage:3.0f}%"),
    (0, "{task.fields[left]}"),
    (76, "{task.fields[speed]:.2f} M particle-steps/s"),
    (100, "Ekin {task.fields[energy]:.3e} J{task.fields[rest]}"),
)
"""What the line holds, each with the width of the terminal from which on there is room for it."""


class Left:
    """The time left as text, or that kernels are being compiled, as it is when it is shown."""

    def __init__(self, compilation):
        self.compilation = compilation
        self.seconds = None  # unknown before the first estimate

    def __format__(self, _):
        spent = self.compilation.running
        if spent is not None:
            return f"compiling, {spent:.0f} s"
        return "-:--:-- left" if self.seconds is None else f"{clock(self.seconds)} left"


def clock(seconds) -> str:
    """Return a time [s] as hours, minutes and seconds."""
    minutes, seconds = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02}:{seconds:02}"


class Bar:
    """A line for a run of a `total` time [s]; a thread of its own keeps it moving."""

    def __init__(self, stream, total, compilation):
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn
        from rich.table import Column

        self.left = Left(compilation)
        self.console = Console(file=stream)
        columns = [
            BarColumn(None, table_column=Column(ratio=1))
            if text is None
            else TextColumn(text, markup=False, table_column=Column(no_wrap=True))
            for width, text in COLUMNS
            if self.console.width >= width
        ]
        self._progress = Progress(
            *columns, console=self.console, refresh_per_second=1 / REFRESH, expand=True
        )
        state = {"step": 0, "time": 0.0, "left": self.left, "speed": 0.0, "energy": 0.0, "rest": ""}
        self._task = self._progress.add_task("run", total=total, **state)
        self._progress.start()

    def update(self, left, time, **state):
        """Show the state of the run: time left and simulated time [s], and the other columns."""
        self.left.seconds = left
        self._progress.update(self._task, completed=time, time=time, **state)

    def print(self, line):
        """Print a line above, as it is."""
        self.console.print(line, highlight=False, markup=False, emoji=False)

    def stop(self):
        """Leave the line as it is."""
        self._progress.stop()
