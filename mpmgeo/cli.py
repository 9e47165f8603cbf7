"""The command line: `mpmgeo case.json`."""

import argparse
import json
import os
import signal
import sys
import warnings
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

from mpmgeo.numerics.environment import Unusable, examine
from mpmgeo.run.interrupt import HANGUP, ending
from mpmgeo.run.terminal import Streams, without_controls

DONE, BAD_INPUT, DIVERGED, INTERRUPTED = 0, 2, 3, 130

COMMANDS = {"benchmark": "mpmgeo.benchmark.command"}
"""Subcommands and the modules that `parse` and `serve` them."""

RESERVED = ("check", "init", "picture", "plot", "report", "sweep", "resume")
"""Words kept free for subcommands; a case file of that name needs a path, like ./check."""

COMPILING = "compiling the kernels for this kind of case (once; later runs start at once)"

MOST_MESSAGES = 100
"""Messages of one kind that are printed; a file with more has one cause."""


def main(argv=None) -> int:
    """Serve a command line (`sys.argv` by default) and return its exit code.

    0 done, 2 bad input or files that cannot be read or written, 3 diverged, 130 interrupted.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    argv = sys.argv[1:] if argv is None else list(argv)
    parse, serve = _parse, _serve
    if argv and argv[0] in COMMANDS:
        module = import_module(COMMANDS[argv.pop(0)])
        parse, serve = module.parse, module.serve
    try:
        arguments = parse(argv)
    except SystemExit as stop:
        return stop.code or DONE
    with _termination_as_interrupt(), warnings.catch_warnings():
        try:
            examine()
            return serve(arguments)
        except KeyboardInterrupt:
            _say("error", "interrupted")
            return INTERRUPTED
        except BrokenPipeError:
            # Python flushes stdout once more at exit, which must not fail again.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return DONE
        except OSError as error:
            name = f"{error.filename}: " if error.filename else ""
            _say("error", f"{name}{error.strerror or error}")
            return BAD_INPUT
        except Unusable as error:
            _say("error", str(error))
            return BAD_INPUT
        except MemoryError:
            _say("error", "the case needs more memory than there is")
            return BAD_INPUT


def run(case, arguments) -> int:
    """Simulate a case, write its files and return the exit code."""
    from mpmgeo.numerics.jit import prepare
    from mpmgeo.output.claim import claimed
    from mpmgeo.run.progress import Compilation, Progress
    from mpmgeo.run.watch import Diverged

    prepare()
    quiet = arguments.quiet
    output = Path(arguments.output)
    with Compilation(lambda: None if quiet else _say("note", COMPILING)) as compilation:
        simulation = _build(case, arguments, output)
        shown = len(simulation.messages)
        watchers = [] if quiet else [Progress(compilation)]
        try:
            with _output_named(), claimed(output, str(arguments.case or arguments.resume)):
                _save_resolved(simulation.case, output)
                simulation.run(watchers=watchers)
        except Diverged as error:
            _say("error", str(error))
            return DIVERGED
        finally:
            if quiet:
                _say_all("warning", simulation.messages[shown:])
    if simulation.interrupted:
        _say("note", f"interrupted after step {simulation.steps}, results in {output.resolve()}")
        if simulation.snapshot is not None and not quiet:
            _say("note", f"mpmgeo --resume {simulation.snapshot} goes on from there")
        return INTERRUPTED
    if not quiet:
        _say("note", f"results are in {output.resolve()}")
    return DONE


@contextmanager
def _output_named():
    """Let the errors of files say that these are the output."""
    from mpmgeo.output.claim import Refused

    try:
        yield
    except (BrokenPipeError, Refused):
        raise
    except OSError as error:
        reason = f"{error.strerror or error} (this is the output of the run)"
        raise OSError(error.errno, reason, error.filename) from error


def check(case, arguments) -> int:
    """Print a case with its defaults filled in, after everything that precedes a run."""
    simulation = _build(case, arguments, output=None)
    print(_resolved_text(simulation.case))
    sys.stdout.flush()
    return DONE


def _serve(arguments):
    from mpmgeo.case.load import CaseError, CaseWarning, load_case

    warnings.simplefilter("ignore", CaseWarning)  # they are printed in the form of this program
    try:
        case = None
        if arguments.case is not None:
            case = load_case(arguments.case, strict=arguments.strict)
            _say_all("note", () if arguments.quiet else case.notes)
            _say_all("warning", case.warnings)
        return (check if arguments.check else run)(case, arguments)
    except CaseError as error:
        _say_all("note", () if arguments.quiet else error.notes)
        _say_all("warning", error.warnings)
        _say_all("error", error.problems)
        count = len(error.problems)
        name = arguments.case or arguments.resume
        _say("error", f"{name}: {count} error{'s'[: count > 1]}; nothing was run")
        return BAD_INPUT


def _build(case, arguments, output):
    """Return the simulation of a case, or raise CaseError with what keeps it from running.

    `case`: None for that of the snapshot to resume.
    """
    from mpmgeo.case.report import CaseError
    from mpmgeo.run.progress import about_step
    from mpmgeo.simulation import Simulation

    options = {"output": output, "threads": arguments.threads}
    try:
        if arguments.resume is None:
            simulation = Simulation(case, **options)
        else:
            options["allow"] = arguments.allow
            simulation = Simulation.resume(arguments.resume, case, **options)
    except CaseError:
        raise
    except ValueError as error:
        raise CaseError([str(error)]) from error
    case = simulation.case
    if simulation.warnings and arguments.strict:
        raise CaseError(simulation.warnings)
    _say_all("warning", simulation.warnings)
    said = {*case.notes, *case.warnings, *simulation.warnings}
    if not arguments.quiet:
        _say_all("note", [text for text in simulation.messages if text not in said])
        _say("note", about_step(simulation))
    return simulation


def _save_resolved(case, folder):
    from mpmgeo.output.whole_file import whole_file

    with whole_file(folder / "resolved-case.json") as file:
        file.write((_resolved_text(case) + "\n").encode())


def _resolved_text(case):
    from mpmgeo.case.load import resolved

    return json.dumps(resolved(case), indent=2, ensure_ascii=False)


def _say_all(kind, texts):
    texts = list(texts)
    for text in texts[:MOST_MESSAGES]:
        _say(kind, text)
    if len(texts) > MOST_MESSAGES:
        _say(kind, f"and {len(texts) - MOST_MESSAGES} more")


def _say(kind, text):
    print(f"{kind}: {without_controls(text)}", file=sys.stderr, flush=True)


@contextmanager
def _termination_as_interrupt():
    """Let SIGTERM and SIGHUP do what Ctrl-C does, also in a process that ignores Ctrl-C."""
    streams = Streams()

    def end(number, _):
        if number == HANGUP:
            streams.hang_up()
            signal.signal(HANGUP, signal.SIG_IGN)
        raise KeyboardInterrupt

    try:
        before = {number: signal.signal(number, end) for number in ending()}
    except ValueError:  # outside the main thread, where signals are not ours to handle
        yield
        return
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _parse(argv):
    parser = argparse.ArgumentParser(
        prog="mpmgeo",
        usage="mpmgeo [options] CASE\n       mpmgeo benchmark [--help] [options]",
        description="Simulate a JSON case with the explicit material point method, "
        "or measure its kernels: benchmark.",
        epilog="Exit codes: 0 done, 2 bad input, 3 the run diverged, 130 interrupted.",
    )
    parser.add_argument("words", metavar="CASE", nargs="*", help="the case file")
    parser.add_argument("--input", metavar="CASE", help="the case file, too")
    parser.add_argument("--output", metavar="DIR", help="folder of the results [working directory]")
    parser.add_argument(
        "--resume", metavar="FILE", help="go on from a snapshot; the case file is not needed"
    )
    parser.add_argument(
        "--allow",
        metavar="KEY",
        action="append",
        default=[],
        help="with --resume: a key that CASE may have another value of, like gravity; repeatable",
    )
    parser.add_argument(
        "--threads", metavar="N", type=_thread_count, help="number of threads, before n_threads"
    )
    parser.add_argument(
        "--check", action="store_true", help="check the case and print it with defaults; no run"
    )
    parser.add_argument("--strict", action="store_true", help="take warnings as errors")
    parser.add_argument("--quiet", action="store_true", help="print warnings and errors only")
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    arguments = parser.parse_args(argv)
    arguments.case = _case_of(parser, arguments)
    if arguments.allow and not (arguments.resume and arguments.case):
        parser.error("--allow goes with --resume and the case file that has the changes")
    arguments.output = arguments.output or _folder_of_run(arguments.resume)
    return arguments


def _folder_of_run(snapshot):
    """Return the folder whose files a resumed run goes on with, or the working directory."""
    from mpmgeo.run.snapshots import FOLDER

    folder = Path(snapshot or ".").parent
    return folder.parent if snapshot and folder.absolute().name == FOLDER else Path()


def _case_of(parser, arguments):
    words = [*arguments.words, *([] if arguments.input is None else [arguments.input])]
    if arguments.words and arguments.words[0] in RESERVED and not Path(words[0]).exists():
        word = arguments.words[0]
        parser.error(f"the word {word} is reserved for a later command; a case file has a path")
    if len(words) > 1 or not (words or arguments.resume):
        parser.error("name one case file" if words else "name a case file, like case.json")
    return words[0] if words else None


def _thread_count(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of threads, 1 or more")
    return int(text)


class _Version(argparse.Action):
    """Looks the version up only when it is asked for, which takes a while."""

    def __call__(self, parser, *_):
        from importlib.metadata import PackageNotFoundError, version

        try:
            print(f"mpmgeo {version('mpmgeo')}")
        except PackageNotFoundError:
            print("mpmgeo, not installed")
        parser.exit()
