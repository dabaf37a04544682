#!/usr/bin/env python3
"""What plans of the shipped scenes claim, against what is true. Most of these fold, and so part from themselves.

    bench/shipped_plans.py CLOTH_RUN DIR [--only TEXT]

plans every scene below with the program CLOTH_RUN, runs the plan for a second, and holds it against velocity_verlet at
a quarter of its stability limit; how that differs from half of the limit is by how much the motion parts from itself. A
claim holds where it is within [0.3, 3] times the true error, or where both are within the tolerance. The motions of
velocity_verlet stay in DIR: delete them after a change of the simulation. It prints a table; exit status 1 says that a
claim does not hold. All takes a few minutes; --only takes the scenes whose line has TEXT.
"""

import argparse
import csv
import os
import re
import resource
import subprocess
import sys

CONFIG = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "config")
SAMPLES = 8
HORIZON = 1.0  # s
CLAIM_RANGE = (0.3, 3.0)
COLUMNS = ("scene", "method", "step, s", "claimed, m", "true, m", "parts by, m", "work, s", "planning, s", "claim")


def scenes():
    """Pairs of a file of config/ and what is set of it."""
    for nodes in (32, 64, 128):
        grid = ["cloth.rows={}".format(nodes), "cloth.cols={}".format(nodes)]
        yield "hanging_sheet", grid
        yield "hanging_sheet", grid + ["strain_limit.max_strain=0"]
    for name in ("flag", "curtain", "hammock", "chain", "free_sheet", "trampoline"):
        yield name, []


def main():
    arguments = parse()
    os.makedirs(arguments.folder, exist_ok=True)
    print("| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|", flush=True)
    all_hold = True
    for name, settings in scenes():
        scene = Scene(arguments, name, settings)
        if arguments.only in scene.title:
            all_hold = check(scene) and all_hold
    sys.exit(0 if all_hold else 1)


def check(scene):
    """Prints a line; whether the claim holds."""
    planning = scene.planning_seconds()
    summary, motion = scene.run("planned", [])
    reference, parting = references(scene)
    true = distance(motion, reference)
    claimed = number_in(summary, "error")
    low, high = CLAIM_RANGE
    holds = low * true <= claimed <= high * true or max(true, claimed) <= number_in(summary, "tolerance")
    numbers = (float(words_in(summary, "time_step")[0]), claimed, true, parting, number_in(summary, "cost"), planning)
    cells = [scene.title, word_in(summary, "method")] + ["{:.2g}".format(number) for number in numbers]
    print("| " + " | ".join(cells + ["holds" if holds else "**fails**"]) + " |", flush=True)
    return holds


def references(scene):
    """The motion at short steps, and by how much it differs from that of steps twice as long."""
    limit = number_in(scene.run("limit", ["solver.method=velocity_verlet"], duration=0.001)[0], "stability_limit")
    half, quarter = (scene.kept_run("reference_" + str(part), ["solver.method=velocity_verlet",
                                                              "solver.time_step={!r}".format(limit / part)])
                     for part in (2, 4))
    return quarter, distance(half, quarter)


class Scene:
    def __init__(self, arguments, name, settings):
        self.title = " ".join([name] + settings)
        self._program = arguments.program
        self._file = os.path.join(CONFIG, name + ".yaml")
        self._settings = settings
        self._path = os.path.join(arguments.folder, re.sub(r"[^a-z0-9]+", "_", self.title) + "_")

    def planning_seconds(self):
        """Of processor time."""
        before = seconds_of_children()
        self._call(["--duration", "0.001"], [])
        return seconds_of_children() - before

    def run(self, name, settings, duration=HORIZON):
        """Summary and motion."""
        path = self._path + name
        self._call(["--duration", repr(duration), "--every", repr(HORIZON / SAMPLES), "--output", path + ".csv",
                    "--summary", path + ".yaml"], settings)
        with open(path + ".yaml", encoding="utf-8") as file:
            return file.read(), motion_in(path + ".csv")

    def kept_run(self, name, settings):
        path = self._path + name + ".csv"
        return motion_in(path) if os.path.exists(path) else self.run(name, settings)[1]

    def _call(self, options, settings):
        pairs = [word for setting in self._settings + settings for word in ("--set", setting)]
        subprocess.run([self._program, self._file] + options + pairs, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)


def seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def motion_in(path):
    """Lists of positions by time, without that at time 0."""
    motion = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            motion.setdefault(float(row["time"]), []).append([float(row[axis]) for axis in "xyz"])
    return [motion[time] for time in sorted(motion) if time > 0.0]


def distance(one, other):
    """Root mean square over nodes and times."""
    squares = [sum((a - b) ** 2 for a, b in zip(node, other_node))
               for nodes, other_nodes in zip(one, other) for node, other_node in zip(nodes, other_nodes)]
    return (sum(squares) / len(squares)) ** 0.5


def number_in(summary, key):
    return float(word_in(summary, key))


def word_in(summary, key):
    """What is chosen stands at the end."""
    return words_in(summary, key)[-1]


def words_in(summary, key):
    return re.findall(r"^ *{}: (.+)$".format(key), summary, re.MULTILINE)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="CLOTH_RUN")
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("--only", metavar="TEXT", default="")
    return parser.parse_args()


if __name__ == "__main__":
    main()
