# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page of a run says in words and tables. Every function gives HTML; all text of a run goes through `text`."""
import html
import math
import shlex


def text(value):
    """Anything as text that HTML shows as it is."""
    return html.escape(str(value), quote=True)


def number(value, digits=4):
    """Three thousand as 3 000, a millionth as 1e-06; a dash for what is not a number."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if float(value) == int(value) and abs(value) < 1e15:
        return f"{int(value):,}".replace(",", "\u202f")
    return f"{value:.{digits}g}"


def with_spread(value, spread):
    """2.513 ± 0.014, as many places as the spread has."""
    if value is None:
        return "–"
    if not spread:
        return number(value)
    places = 1 - math.floor(math.log10(spread))
    if places < 0 or abs(value) >= 1e6 or places > 6:
        return f"{value:.4g} ± {spread:.2g}"
    return f"{value:.{places}f} ± {spread:.{places}f}"


def seconds(value):
    if value is None:
        return "–"
    if value < 120:
        return f"{value:.3g} s"
    minutes = value / 60
    return f"{minutes:.0f} min" if minutes < 120 else f"{minutes / 60:.1f} h"


CARDS = 5  # results shown at once
STATUS = {"done": "done", "failed": "failed", "interrupted": "stopped", "running": "running", "ended": "broken off"}


def lead(run, facts):
    """One line under the title: how many grains, how long, what it took."""
    parts = []
    if facts["most_grains"]:
        parts.append(f"{number(facts['most_grains'])} spheres")
    summary = run.summary()
    if summary:
        parts.append(f"{number(summary['time']['simulated'])} s simulated in {seconds(summary['timing']['wall'])}")
    elif facts["last_time"] is not None:
        parts.append(f"{number(facts['last_time'])} of {number(run.scene().get('time', {}).get('duration'))} s so far")
    return " · ".join(text(part) for part in parts)


def incidents(run):
    """Why a run failed."""
    told = run.summary().get("incidents", [])
    if not told:
        return ""
    items = "".join(f"<li>{text(one.get('sentence', ''))}</li>" for one in told[:5])
    more = f"<li>and {len(told) - 5} more</li>" if len(told) > 5 else ""
    return f"<ul class='incidents'>{items}{more}</ul>"


def results(run):
    """A card for each number that a sensor found."""
    cards = []
    for sensor, quantities in run.summary().get("sensors", {}).items():
        silent = [one["silence"] for one in quantities.values() if one.get("value") is None and one.get("silence")]
        for name, one in quantities.items():
            if one.get("value") is not None:
                unit = "" if one.get("unit") in (None, "1") else {"deg": "°", "kg/s": "kg/s"}.get(one["unit"], one["unit"])
                told = with_spread(one["value"], one.get("spread"))
                if one.get("caution"):  # the sentence stands with the errors of the run
                    told = told.replace("±", "± at least")
                cards.append(f"<div class='card'><span>{text(sensor)} · {text(name.replace('_', ' '))}</span>"
                             f"<b>{text(told)}&thinsp;<small>{text(unit)}</small></b>{changes(one)}</div>")
        if silent and len(silent) == len(quantities):
            cards.append(f"<div class='card quiet'><span>{text(sensor)}</span><p>{text(silent[0])}</p></div>")
    if not cards:
        return ""
    shown, hidden = cards[:CARDS], cards[CARDS:]
    more = f"<details class='more'><summary>{len(hidden)} more results</summary><div class='cards'>{''.join(hidden)}</div></details>" if hidden else ""
    return f"<div class='cards'>{''.join(shown)}</div>{more}"


def changes(result):
    """What companions have found of step and solver; nothing where the run had none."""
    parts = []
    for cause in ("step", "solver"):
        found = result.get(cause)
        if found:
            bound = "below " if found["error"] and not found["seen"] else ""
            parts.append(f"{cause} ± " + ("?" if found["error"] is None else bound + number(found["error"], 2)))
    return f"<span>{text(' · '.join(parts))}</span>" if parts else ""


# What a run tells of itself when it is over, in this order.
EXPLAINED = {"model": "The run", "step": "Time step", "overlap": "Contacts", "solver": "Solver chosen", "accuracy": "Accuracy"}


def modelled(run):
    """What the run says that it models and leaves out, and the numbers of the scene for it."""
    scene, told = run.scene(), run.summary().get("explanations", {})
    contacts, walls, world = scene.get("contact", []), scene.get("wall", []), scene.get("world", {})

    def range_of(key):
        values = sorted({contact.get(key, 0.0) for contact in contacts})
        return number(values[0]) if values and values[0] == values[-1] else f"{number(values[0])} to {number(values[-1])}" if values else "0"

    rows = [(name, told[key]) for key, name in EXPLAINED.items() if told.get(key)]
    for name, key, law in (("Friction", "friction", "Coulomb, μ = "), ("Restitution", "restitution", "Newton, e = "),
                           ("Rolling resistance", "rolling_friction", "torque up to μᵣ N R*, μᵣ = ")):
        if any(one.get(key) for one in contacts):
            rows.append((name, law + range_of(key)))
    if not world.get("rotation", True):
        rows.append(("Rotation", "left out"))
    rows.append(("Gravity", ", ".join(number(float(one)) for one in world.get("gravity", [])) + " m/s²"))
    moving = [wall["name"] for wall in walls if wall.get("motion")]
    pistons = [wall["name"] for wall in walls if math.isfinite(wall.get("mass", math.inf))]
    rows.append(("Walls", ", ".join(wall["name"] for wall in walls) or "none"))
    if moving:
        rows.append(("Moving as told", ", ".join(moving)))
    if pistons:
        rows.append(("Of finite mass", ", ".join(pistons)))
    if world.get("periodic"):
        rows.append(("Periodic along", ", ".join(world["periodic"])))
    for name, material in scene.get("materials", {}).items():
        rows.append((f"Material {name}", f"{number(material.get('density'))} kg/m³"))
    solver = scene.get("solver", {})
    rows.append(("Solver", f"{solver.get('stabilisation', 'auto')}, tolerance {solver.get('tolerance', 'auto')}, "
                           f"up to {solver.get('max_sweeps', 100)} sweeps a step"))
    return table(rows)


def table(rows, head=()):
    """Rows of two or more cells; the first is what the others are about."""
    lines = "".join("<tr><th scope='row'>" + text(first) + "</th>" + "".join(f"<td>{text(cell)}</td>" for cell in rest) + "</tr>"
                    for first, *rest in rows)
    top = "<thead><tr>" + "".join(f"<th scope='col'>{text(cell)}</th>" for cell in head) + "</tr></thead>" if head else ""
    return f"<table>{top}<tbody>{lines}</tbody></table>"


def error(run):
    """How wrong the run may be."""
    summary = run.summary()
    if not summary:
        return ""
    found, steps = summary["error"], summary["time"]["steps"]
    residual, overlap, energy = found["residual"], found["overlap_d"], found["energy"]
    sub_steps, momentum = found.get("sub_steps", {}), found.get("momentum", {})
    rows = [("Residual", f"mean {number(residual['mean'], 2)}, 95 % of the steps below {number(residual['percentile_95'], 2)}, "
                         f"worst {number(residual['worst'], 2)}; asked for {number(residual['tolerance'], 2)}"),
            ("Steps at the cap of sweeps", f"{number(residual['steps_at_cap'])} of {number(steps)}"),
            *solver_error(found.get("solver", {})),
            *companions(found.get("companions", {})),
            ("Overlap", f"mean {percent(overlap['mean'])} d, worst {percent(overlap['worst'])} d at {number(overlap.get('worst_at'))} s"),
            ("Energy that nothing put in", f"{number(energy['gained'], 2)} J, beside {number(energy['lost'])} J lost to friction and impacts"
                                           + (f" and {number(energy['put_in'])} J put in" if energy.get("put_in") else ""))]
    if momentum:
        rows.append(("Momentum left over", f"{number(momentum['left_over'], 2)} N s, beside {number(momentum['from_gravity'])} N s from gravity"))
    for sensor, quantities in summary["sensors"].items():
        told = [one["caution"] for one in quantities.values() if one.get("caution")]
        if told:
            rows.append((f"Spread of {sensor}", told[0]))
    if sub_steps.get("steps"):
        asked_by = f", for {sub_steps['asked_by']}" if sub_steps.get("asked_by") else ""
        rows.append(("Steps split", f"{number(sub_steps['steps'])}, into {number(sub_steps['most'])} at most{asked_by}"))
    return table(rows)


def solver_error(found):
    """What the run found when it solved some of its steps to the end."""
    if not found.get("looks"):
        return [("Error of the solver", "unknown: the run was too short to look at it")] if found else []
    velocity = found["velocity"]
    rows = [("Error of velocities", f"{number(velocity['error'], 2)} m/s: {percent(velocity['of_flow'])} of the flow's, "
                                    f"{percent(velocity['of_contacts'])} of what contacts change in a step"),
            ("Error of contact forces", f"{percent(found['contact_forces'])} of their mean")]
    rows += [(f"Error of the force on {name}", f"{number(wall['error'], 2)} N, beside {number(wall['force'])} N")
             for name, wall in found["wall_forces"].items()]
    rows.append(("Found by", f"{number(found['looks'])} steps made once more, {number(found['to_the_end'])} of them a thousand times as well, "
                             f"all to a residual of {number(found['residual'], 2)}"))
    return rows


def companions(found):
    """Which pieces of the run were made again for what is said of step and solver beside each result."""
    if not found.get("pieces"):
        return []
    return [("Companions", f"{number(found['pieces'])} pieces of {number(found['length'], 3)} s made again: as they were, with another "
                           "seed, with half the step, with a tenth of the tolerance")]


def percent(share):
    return "–" if share is None else f"{100 * share:.2g} %"


def ledger(run):
    summary = run.summary()
    if not summary:
        return ""
    one = summary["ledger"]
    rows = [("Inserted", number(one["inserted"])), ("Inside at the end", number(one["inside"])),
            ("Left through an outlet", number(one["left"])), ("Escaped", number(one["escaped"])),
            ("The sum", "closes" if one["closes"] else "does not close: spheres were lost")]
    for pour in summary.get("pours", []):
        if pour.get("shortfall"):
            rows.append((f"Pour {pour['name']}", f"{number(pour['poured'])} came in: {pour['shortfall']}"))
    return table(rows)


def timing(run):
    """Where the time went, with a bar for each phase."""
    summary = run.summary()
    if not summary:
        return ""
    one = summary["timing"]
    rows = []
    for name, phase in one["phases"].items():
        share = 100 * phase["cpu"] / one["cpu"] if one["cpu"] else 0.0
        rows.append(f"<tr><th scope='row'>{text(name.replace('_', ' '))}</th><td>{text(seconds(phase['cpu']))}</td>"
                    f"<td class='bar'><i style='width:{share:.1f}%'></i></td><td>{share:.1f} %</td></tr>")
    simulated = summary["time"]["simulated"]
    rate = one.get("contact_updates_per_cpu_second")
    note = (f"{seconds(one['wall'])} by the clock, {seconds(one['cpu'])} of processor time on {number(summary['threads'])} "
            f"thread{'s' if summary['threads'] != 1 else ''}; {number(summary['time']['steps'])} steps of {number(summary['time']['step'], 3)} s")
    if simulated:
        note += f"; {number(one['cpu'] / simulated, 3)} s of processor time for a simulated second"
    if rate:
        note += f"; {rate / 1e6:.3g} million contact updates a second of the sweeps"
    return (f"<table class='bars'><thead><tr><th scope='col'>phase</th><th scope='col'>processor</th><th></th><th scope='col'>share</th></tr></thead>"
            f"<tbody>{''.join(rows)}</tbody></table><p class='soft'>{text(note)}.</p>")


def repeat(run):
    """The command, the scene, how to cite."""
    summary, scene = run.summary(), run.scene()
    version, name = summary.get("version"), summary.get("scene")
    command = f"talus run {shlex.quote(str(run.folder / 'scene.resolved.toml'))} -o again"
    rows = [("Scene", name or run.title()), ("Seed", number(scene.get("seed", 1))), ("Version", f"Talus {version}" if version else "–")]
    source = (run.folder / "scene.resolved.toml").read_text(encoding="utf-8", errors="replace")
    citation = (f"Talus{' ' + version if version else ''}: granular dynamics, spheres in frictional contact. "
                f"Scene “{run.title()}”, seed {scene.get('seed', 1)}.")
    return (f"{table(rows)}<p>The same bits, with any number of threads, from the scene with every key written out:</p>"
            f"<pre class='copy'>{text(command)}</pre>"
            f"<p>To cite it:</p><pre class='copy wrap'>{text(citation)}</pre>"
            f"<details><summary>The scene with every key</summary><pre class='scene'>{text(source)}</pre></details>")


def all_sections(run, facts):
    """Every part of the page that is words, by the id of its place."""
    return {"lead": lead(run, facts), "incidents": incidents(run), "results": results(run), "modelled": modelled(run),
            "error": error(run), "ledger": ledger(run), "timing": timing(run), "repeat": repeat(run)}
