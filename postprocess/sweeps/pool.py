# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs processes on this machine, some at a time.

The case of a sweep is a process of `talus run DIR --case N`, which knows by itself what there is to do. All have a process group
of their own, so that the Ctrl-C of a terminal reaches the pool alone, which then asks each of them to stop, once.
"""
import contextlib
import ctypes
import os
import select
import signal
import subprocess
import sys
import tempfile
import time

from sweeps.results import state_of

POLL = 500  # ms between two looks at the clock


class Stopped(Exception):
    """A signal asked the pool to stop; its number."""


def stop(number, _):
    raise Stopped(number)


def ask_to_stop_with_parent():
    """Whoever kills the pool, its processes stop; cases write a checkpoint."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG


class Process:
    """A process of the pool."""

    def __init__(self, words, **options):
        self.complaints = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")  # noqa: SIM115  closed in end()
        self.process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stderr=self.complaints, process_group=0, preexec_fn=ask_to_stop_with_parent, **options)
        self.descriptor = os.pidfd_open(self.process.pid)

    def end(self):
        """How it ended: its exit code, and the last line that it said."""
        code = self.process.wait()
        os.close(self.descriptor)
        with self.complaints as file:
            file.seek(0)
            lines = file.read().strip().splitlines()
        return code, lines[-1] if lines else f"ended with {code}"


class Case(Process):
    """A case that is being run."""

    def __init__(self, talus, folder, number):
        self.folder, self.number = folder, number
        super().__init__([talus, "run", folder.path, "--case", str(number), "--quiet"])


class Progress:
    """One line that tells how far the pool is: in place on a terminal, else now and then."""

    def __init__(self, total, settled, quiet):
        self.total, self.settled, self.quiet = total, settled, quiet
        self.failed = self.new = 0
        self.began = self.told = time.monotonic()
        self.terminal = sys.stdout.isatty()

    def add(self, is_new, has_failed):
        self.settled += is_new
        self.new += is_new
        self.failed += has_failed

    def tell(self, running):
        now = time.monotonic()
        if self.quiet or now - self.told < (1 if self.terminal else 30):
            return
        self.told = now
        left = self.total - self.settled
        eta = f"about {duration((now - self.began) * left / self.new)} left" if self.new else "no case is over yet"
        text = f"{self.settled} of {self.total} cases, {self.failed} failed; {running} running; {eta}"
        print(f"\r\x1b[K{text}" if self.terminal else text, end="" if self.terminal else "\n", flush=True)

    def finish(self):
        if self.terminal and not self.quiet:
            print("\r\x1b[K", end="", flush=True)


def duration(seconds):
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def run_all(talus, jobs, folders, quiet=False):
    """Brings every case of some sweeps to its end. Returns a sentence for each that could not be brought there.

    Raises Stopped when a signal came, after the cases have stopped.
    """
    waiting = [(folder, number) for folder in folders for number in folder.cases()]
    before = {(folder.path, number): state_of(folder.run_of(number))[0] != "unfinished" for folder, number in waiting}
    progress = Progress(len(waiting), sum(before.values()), quiet)
    waiting.sort(key=lambda one: not before[one[0].path, one[1]])  # what is settled first, as that takes no time
    complaints = []

    def ended(case):
        code, said = case.end()
        if code != 0:
            complaints.append(f"case {case.number} of {case.folder.path}: {said}")
            return
        failed = state_of(case.folder.run_of(case.number))[0] == "failed"
        progress.add(not before[case.folder.path, case.number], failed)

    try:
        run_processes(waiting, jobs, lambda one: Case(talus, *one), ended, progress.tell)
    finally:
        progress.finish()
    return complaints


def run_processes(jobs, at_once, begin, ended, tell=lambda running: None):
    """Runs all jobs, so many at a time: `begin(job)` returns a Process, `ended(process)` is called when it is over, in any
    order, and `tell(running)` now and then.

    Raises Stopped when a signal came, after what ran was asked to stop and has ended.
    """
    waiting, running = list(reversed(jobs)), {}
    poll = select.poll()
    with signals_stop():
        try:
            while waiting or running:
                while waiting and len(running) < at_once:
                    process = begin(waiting.pop())
                    running[process.descriptor] = process
                    poll.register(process.descriptor, select.POLLIN)
                for descriptor, _ in poll.poll(POLL):
                    poll.unregister(descriptor)
                    ended(running.pop(descriptor))
                tell(len(running))
        finally:
            for process in running.values():
                process.process.terminate()
            for process in running.values():
                process.end()


@contextlib.contextmanager
def signals_stop():
    """While it lasts, Ctrl-C and its like raise Stopped; once, so that the cases can be waited for."""
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

    def first(number, frame):
        for one in numbers:
            signal.signal(one, signal.SIG_IGN)
        stop(number, frame)

    old = [signal.signal(number, first) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, old):
            signal.signal(number, handler)
