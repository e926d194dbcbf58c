# SPDX-License-Identifier: GPL-3.0-or-later
"""Splits the wall time of a command into phases, using its summary.json and the measured time of its process."""
import statistics

# phases in timing_s of summary.json, in the order of a run; "solve" there is a sum of several phases and is not listed
TIMED = ["start", "specimen", "tessellation", "network", "planning", "preconditioner", "harmonic", "stepper",
         "stepping", "writing"]
REST = "rest"  # process start, reading the scene, end of the process
PHASES = [*TIMED, REST]
WALL = "wall"


def phases_of(summary, wall, processor=None):
    """Returns the seconds of each phase of a run that took `wall` seconds from process start to exit.

    The phase "rest" is the wall time that the phases of summary.json do not cover. A large rest shows that a phase is
    missing from summary.json or counted twice. Its limit is 5 % of the wall time, or 0.3 s if that is more, because
    a process needs some time to start and to end. `processor` is the processor time of the process [s], if known. The
    difference of wall time and processor time, in which a process of one thread waited for a core, is added to the
    limit, so that a busy machine does not make a run fail. Raises ValueError with the sum of the phases, the wall time
    and the limit."""
    if summary.get("status") != "done":
        raise ValueError(f"summary.json: status '{summary.get('status')}', expected 'done'")
    timing = summary["timing_s"]
    missing = [phase for phase in TIMED if phase not in timing]
    if missing:
        raise ValueError(f"summary.json: timing_s has no {', '.join(missing)}")
    phases = {phase: float(timing[phase]) for phase in TIMED}
    for phase, seconds in phases.items():
        if not seconds > -1e-6:  # differences of clock readings are rounded
            raise ValueError(f"summary.json: timing_s, {phase}: {seconds} s")
    total = sum(phases.values())
    waited = 0.0 if processor is None else max(0.0, wall - processor)
    rest, limit = wall - total, max(0.05 * wall, 0.3) + waited
    if not -1e-3 <= rest <= limit:  # both clocks advance without jumps
        raise ValueError(f"the phases of summary.json sum up to {total:.3f} s of {wall:.3f} s of wall time; at most "
                         f"{limit:.3f} s of that may be left")
    return {**phases, REST: rest}


def collected(runs):
    """Returns (phase, median, smallest, largest) for each phase over several runs, each a dictionary of phases. The
    last entry is for the wall time."""
    named = [*((phase, [run[phase] for run in runs]) for phase in PHASES),
             (WALL, [sum(run.values()) for run in runs])]
    return [(name, statistics.median(values), min(values), max(values)) for name, values in named]
