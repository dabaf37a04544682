"""The verdict in words, as Markdown."""

from collections import Counter

from plan_matrix import verdict
from work_precision import words

MOST_LISTED = 12

HOW = """\
Errors are RMS over all nodes and eight times of one simulated second against the motion of the full model. Costs are
processor time in lengths of a yardstick that was measured beside every run; a plan and the best of the search were timed
in turn. The development half was looked at while the planner was built, the held-out half was not."""


def write(path, halves):
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join(sections(halves)) + "\n")


def sections(halves):
    yield "# The planner's choices against an exhaustive search"
    yield HOW
    for half in halves:
        yield "## " + half.name.replace("_", " ").capitalize()
        yield facts(half)
        judged = verdict.criteria(half)
        yield table(judged)
        for criterion in judged:
            if verdict.failing(criterion):
                yield failures(criterion)
        yield refused(half)


def facts(half):
    scenes = {plan.scene for plan in half.plans}
    commits = sorted({plan.commit for plan in half.plans})
    missed = [verdict.about(plan) for plan in half.plans if verdict.admits_failure(plan)]
    text = "{} scenes, {} plans of commit {}. {}".format(len(scenes), len(half.plans), ", ".join(commits),
                                                        methods(half.plans))
    if missed:
        text += " Plans that say themselves that they miss the tolerance: {}.".format(shortened(missed))
    return text


def methods(plans):
    chosen = Counter(plan.method or "none" for plan in plans).most_common()
    best = Counter(plan.best_solver or "none" for plan in plans).most_common()
    return "Chosen: {}. Best of the search: {}.".format(*(
        words.listed(["{} {}".format(name, count) for name, count in found]) for found in (chosen, best)))


def table(criteria):
    lines = ["| | asked for | good | needed | |", "|---|---|---|---|---|"]
    for criterion in criteria:
        found = verdict.share(criterion)
        cells = "-" if found is None else "{:.1f} % of {}".format(100.0 * found, len(criterion.cases))
        lines.append("| {} | {} | {} | {:.0f} % | {} |".format(
            criterion.name, criterion.asked, cells, 100.0 * criterion.needed, in_a_word(verdict.holds(criterion))))
    return "\n".join(lines)


def in_a_word(holds):
    return {True: "holds", False: "**fails**", None: "nothing to judge"}[holds]


def failures(criterion):
    cases = sorted(verdict.failing(criterion), key=lambda case: case.value or 0.0)
    listed = ["{} ({})".format(case.about, "no number" if case.value is None else words.rounded(case.value))
              for case in cases]
    return "Not {}: {}.".format(criterion.name, shortened(listed))


def shortened(items):
    if len(items) <= MOST_LISTED:
        return "; ".join(items)
    half = MOST_LISTED // 2
    return "; ".join(items[:half]) + "; {} more; ".format(len(items) - 2 * half) + "; ".join(items[-half:])


def refused(half):
    """Every draw that became no scene, with its reason."""
    lines = ["- {} ({:.0f} x {:.0f} nodes): {}".format(draw.scene, draw.rows, draw.cols, draw.reason)
             for draw in half.draws if draw.accepted == "no"]
    return "Draws that were replaced: {}.".format(len(lines)) + ("\n\n" + "\n".join(lines) if lines else "")
