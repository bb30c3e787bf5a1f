# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and page of a sweep, from what its cases have left so far."""
from run_page.writing import write_whole
from sweeps.page import sweep_page
from sweeps.results import read_cases, write_tables


def gather(folder):
    """Writes them. Returns a sentence on what there is."""
    cases = read_cases(folder)
    names = write_tables(folder, cases)
    write_whole(folder.path / "sweep.html", sweep_page(folder, cases))
    counts = {state: sum(case.state == state for case in cases) for state in ("done", "failed", "unfinished")}
    parts = [f"{counts['done']} done", f"{counts['failed']} failed"] + ([f"{counts['unfinished']} unfinished"] if counts["unfinished"] else [])
    if mixed := [case for case in cases if case.state == "unfinished" and case.reason]:
        parts.append(f"{len(mixed)} of these left out, the first case {mixed[0].number}: {mixed[0].reason}")
    return f"{len(cases)} cases: {', '.join(parts)}; {', '.join(str(folder.path / name) for name in [*names, 'sweep.html'])}"
