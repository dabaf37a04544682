"""The summary of a run of cloth_bench in words, as Markdown."""

from collections import Counter

from work_precision import grid, rankings, solvers, words

HOW = """\
Errors are RMS over all nodes against the reference, in metres; costs are seconds of work a simulated second. A method's
cost at an error is the least at which it stays below: that of a run, or on the straight line, in logarithms, between
two neighbouring settings of its ladder (marked ~). Costs that differ by less than 20 % count as level."""

GRID = """\
Each grid against the one twice as fine as the finest here, on the same places of the sheet. An error in time that is
far below it is not worth its cost."""


def write_summary(path, scenes, runs, command):
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join(sections(scenes, runs, command)) + "\n")


def sections(scenes, runs, command):
    accepted = {kind: [scene for scene in scenes if scene.kind == kind and scene.accepted == "yes"]
                for kind in ("trajectory", "limited", "spatial")}
    yield "# Speed against accuracy: summary"
    yield made_by(runs, command)
    yield HOW
    if accepted["trajectory"]:
        yield "## Which method is cheapest"
        yield winners_in_words(accepted["trajectory"], runs)
        yield winners_table(accepted["trajectory"], runs)
        for scene in accepted["trajectory"]:
            yield from scene_section(scene, runs_of(scene, runs), grid.own_grid(scene, runs))
    if accepted["limited"]:
        yield "## With the strain limit, against the same rule at h to 0"
        for scene in accepted["limited"]:
            yield from scene_section(scene, runs_of(scene, runs))
    if accepted["spatial"]:
        yield "## Error of the grid"
        yield GRID

        yield "\n".join(spatial_line(scene, runs) for scene in accepted["spatial"])
    yield "## Failures"
    yield failures(runs)
    yield "## Scenes that were refused"
    yield refused(scenes)


def runs_of(scene, runs):
    return [run for run in runs if (run.scene, run.kind) == (scene.scene, scene.kind)]


def made_by(runs, command):
    lines = ["- command: `{}`".format(command)]
    for name in ("machine", "compiler", "commit"):
        found = sorted({getattr(run, name) or "not known" for run in runs})
        lines.append("- {}: {}".format(name, "; ".join(found)))
        if len(found) > 1:
            lines.append("- **the runs are not of one {}: their costs do not compare**".format(name))
    return "\n".join(lines)


def winners_table(scenes, runs):
    lines = ["| scene | " + " | ".join(words.tolerance(error) for error in rankings.TOLERANCES) + " |",
             "|---" * (len(rankings.TOLERANCES) + 1) + "|"]
    for scene in scenes:
        cells = [winner_cell(rankings.ranking(runs_of(scene, runs), error)) for error in rankings.TOLERANCES]
        lines.append("| {} | {} |".format(scene.scene, " | ".join(cells)))
    return "\n".join(lines)


def winner_cell(ranking):
    if not ranking:
        return "none"
    names = [entry.solver for entry in ranking if is_level(entry, ranking[0])]
    return "{} {} s".format(", ".join(names), words.rounded(ranking[0].cost))


def is_level(entry, first):
    return entry.cost < rankings.LEVEL * first.cost


def winners_in_words(scenes, runs):
    return "\n".join(most_wins(scenes, runs, error) for error in rankings.TOLERANCES)


def most_wins(scenes, runs, error):
    """Over all scenes: who is first, or level with the first, how often."""
    found = [ranking for ranking in (rankings.ranking(runs_of(scene, runs), error) for scene in scenes) if ranking]
    begin = "- **{}**: ".format(words.tolerance(error))
    if not found:
        return begin + "no run of any scene is that exact."
    wins = Counter(entry.solver for ranking in found for entry in ranking if is_level(entry, ranking[0]))
    names = sorted(solvers.in_order(wins), key=lambda name: -wins[name])
    parts = ["{} in {}".format(name, wins[name]) for name in names]
    return begin + "of {} {}, cheapest or level with it is {}; faster than real time in {}.".format(
        len(found), "scene" if len(found) == 1 else "scenes", words.listed(parts),
        sum(ranking[0].cost < 1.0 for ranking in found))


def scene_section(scene, runs, own_grid=None):
    yield "### " + scene.scene
    yield scene_facts(scene, runs, own_grid)
    yield "\n".join(tolerance_line(rankings.ranking(runs, error), error) for error in rankings.TOLERANCES)
    yield ranking_table(runs)
    if any(run.setting == "step" for run in runs):
        yield slope_table(scene, runs)


def scene_facts(scene, runs, own_grid):
    facts = []
    nodes = sorted({run.nodes for run in runs if run.nodes})
    if nodes:
        facts.append("{} nodes".format(words.listed(["{:.0f}".format(number) for number in nodes])))
    if scene.horizon is not None:
        facts.append("compared up to {} s".format(words.rounded(scene.horizon)))
    if scene.reference_error is not None:
        facts.append("the reference is certain to {} m RMS".format(words.rounded(scene.reference_error)))
    if scene.growth is not None:
        facts.append("a disturbance of 1e-9 grew {}".format(words.times(scene.growth)))
    if own_grid is not None:
        distance = words.rounded(own_grid.rms_error)
        facts.append("a finer grid is {} m off {}".format(distance, grid.horizon_in_words(own_grid)).strip())
    text = "; ".join(facts) + "." if facts else ""
    return (text + " " + sentence(scene.reason)).strip()


def sentence(text):
    text = text.strip()
    return text[:1].upper() + text[1:].rstrip(".") + "." if text else ""


def tolerance_line(ranking, error):
    """Who wins at an error and by how much, against our other methods and against the independent solvers."""
    begin = "- **{}**: ".format(words.tolerance(error))
    if not ranking:
        return begin + "no run is that exact."
    ours = [entry for entry in ranking if solvers.is_ours(entry.solver)]
    others = [entry for entry in ranking if not solvers.is_ours(entry.solver)]
    parts = ([race(ours)] if ours else ["none of our methods got there in the time given"]) + [against(ours, others)]
    return begin + "; ".join(part for part in parts if part) + "."


def race(entries):
    first = entries[0]
    level = [entry for entry in entries[1:] if is_level(entry, first)]
    behind = entries[1 + len(level):]
    text = "{} {}with {}, {}".format(first.solver, "" if level else "wins ", words.setting(first.setting, first.value),
                                     speed(first))
    if level:
        names = words.listed([entry.solver for entry in level])
        text += "; {} {} level".format(names, "is" if len(level) == 1 else "are")
    if behind:
        text += "; next is {}, {} the cost".format(behind[0].solver, words.times(behind[0].cost / first.cost))
    return text + ("" if level or behind else "; no other of ours got there in the time given")


def speed(entry):
    if entry.cost < 1.0:
        return "{} s a simulated second, {} as fast as real time".format(
            words.rounded(entry.cost), words.times(1.0 / entry.cost))
    return "{} s a simulated second, slower than real time".format(words.rounded(entry.cost))


def against(ours, others):
    if not others:
        return "no independent solver got there in the time given" if ours else ""
    other = others[0]
    text = "the best independent solver, {} with {}, ".format(other.solver, words.setting(other.setting, other.value))
    if not ours:
        return text + "takes " + speed(other)
    factor = other.cost / ours[0].cost
    if 1.0 / rankings.LEVEL < factor < rankings.LEVEL:
        return text + "is level with it"
    if factor < 1.0:
        return text + "is cheaper: ours takes {} its cost".format(words.times(1.0 / factor))
    return text + "takes {} the cost".format(words.times(factor))


def ranking_table(runs):
    """Costs of all solvers; bold: the least, and what is level with it."""
    found = [{entry.solver: entry for entry in rankings.ranking(runs, error)} for error in rankings.TOLERANCES]
    lines = ["| s a simulated second | " + " | ".join(words.tolerance(error) for error in rankings.TOLERANCES) + " |",
             "|---" * (len(found) + 1) + "|"]
    names = solvers.in_order(run.solver for run in runs)
    nowhere = [name for name in names if not any(name in entries for entries in found)]
    for name in names:
        if name not in nowhere:
            cells = [cost_cell(entries.get(name), entries.values()) for entries in found]
            lines.append("| {} | {} |".format(name, " | ".join(cells)))
    return "\n".join(lines + after_table("Not as exact as any of these in the time given", nowhere))


def after_table(text, names):
    return ["", "{}: {}.".format(text, words.listed(names))] if names else []


def cost_cell(entry, entries):
    if entry is None:
        return "-"
    text = ("" if entry.measured else "~") + words.rounded(entry.cost)
    return "**{}**".format(text) if is_level(entry, min(entries)) else text


def slope_table(scene, runs):
    floor = 10.0 * (scene.reference_error or 0.0)
    found = {name: rankings.slope(ladder, floor) for (name, setting), ladder in rankings.ladders(runs).items()
             if setting == "step"}
    lines = ["| order | claimed | measured | steps |", "|---|---|---|---|"]
    for name, slope in found.items():
        if slope:
            claimed = solvers.OURS[name].order if name in solvers.OURS else "-"
            lines.append("| {} | {} | {:.2f} | {}, {} to {} |".format(
                name, claimed, slope.slope, slope.points, words.seconds(slope.begin), words.seconds(slope.end)))
    rest = after_table("Nowhere three steps in a row on one slope", [name for name in found if not found[name]])
    return "\n".join(lines + rest if len(lines) > 2 else rest[1:])


def spatial_line(scene, runs):
    found = grid.grids(scene.scene, runs)
    if not found:
        return "- {}: no run.".format(scene.scene)
    errors = ["{} m with {:.0f}".format(words.rounded(run.rms_error), run.value) for run in found]
    order = grid.order_in_words(found)
    return "- {} {}: {} nodes down the sheet{}.".format(scene.scene, grid.horizon_in_words(found[0]), ", ".join(errors),
                                                      "; " + order if order else "")


def failures(runs):
    groups = {}
    for run in sorted(runs, key=lambda run: run.value):
        if run.status != "ok":
            groups.setdefault((run.scene, run.kind, run.solver, run.status, run.setting), []).append(run.value)
    if not groups:
        return "None."
    lines = ["| scene | solver | | with |", "|---|---|---|---|"]
    names = solvers.in_order(run.solver for run in runs)
    for key in sorted(groups, key=lambda key: (key[:2], names.index(key[2]), key[3:])):
        scene, _, solver, status, setting = key
        lines.append("| {} | {} | {} | {} |".format(
            scene, solver, words.STATUS_WORDS[status], words.settings(setting, groups[key])))
    return "\n".join(lines)


def refused(scenes):
    lines = ["- {} ({}): {}".format(scene.scene, scene.kind, sentence(scene.reason) or "No reason is given.")
             for scene in scenes if scene.accepted == "no"]
    return "\n".join(lines) or "None."
