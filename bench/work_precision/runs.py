"""The two CSV files that cloth_bench writes, read and checked.

Columns beyond those named here are let be.
"""

import csv
import math
import os
from collections import namedtuple

KINDS = ("trajectory", "limited", "spatial")
SETTINGS = ("step", "tolerance", "iterations", "nodes_per_side")
STATUSES = ("ok", "unstable", "not_converged", "too_slow")

RUN_COLUMNS = (
    "scene kind solver setting value horizon status rms_error worst_error energy_error strain_error "
    "seconds_per_second seconds_per_second_low seconds_per_second_high repeats force_evaluations solves "
    "reference_error nodes tolerance_line machine compiler commit").split()
RUN_WORDS = {"kind": KINDS, "setting": SETTINGS, "status": STATUSES}
RUN_TEXTS = ("scene", "solver", "machine", "compiler", "commit")
RUN_NEEDS = ("scene", "kind", "solver", "setting", "value", "status")

SCENE_COLUMNS = "scene kind accepted horizon reference_error growth reason".split()
SCENE_WORDS = {"kind": KINDS, "accepted": ("yes", "no")}
SCENE_TEXTS = ("scene", "reason")
SCENE_NEEDS = ("scene", "kind", "accepted")

Run = namedtuple("Run", RUN_COLUMNS)
Scene = namedtuple("Scene", SCENE_COLUMNS)


class Malformed(Exception):
    """Says which file, line and column, what stands there and what is allowed."""


def read(folder):
    """The scenes and the runs of a folder, in the order of the files. A number that does not apply is None."""
    scenes = read_table(os.path.join(folder, "scenes.csv"), Scene, SCENE_WORDS, SCENE_TEXTS, SCENE_NEEDS)
    path = os.path.join(folder, "runs.csv")
    runs = read_table(path, Run, RUN_WORDS, RUN_TEXTS, RUN_NEEDS, check_run)
    check_together(path, scenes, runs)
    return scenes, runs


def read_table(path, row_type, words, texts, needs, check=None):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(rows(file, path, row_type, words, texts, needs, check))
    except OSError as error:
        raise Malformed("{}: {}".format(path, error.strerror)) from error
    except UnicodeDecodeError as error:
        raise Malformed("{}: is not text in UTF-8".format(path)) from error


def rows(file, path, row_type, words, texts, needs, check):
    lines = csv.reader(file)
    header = next(lines, [])
    missing = [name for name in row_type._fields if name not in header]
    if missing:
        raise Malformed("{}, line 1: no column {}".format(path, ", ".join(missing)))
    for cells in lines:
        where = "{}, line {}".format(path, lines.line_num)
        if len(cells) != len(header):
            raise Malformed("{}: {} fields, but the header has {}".format(where, len(cells), len(header)))
        named = dict(zip(header, cells))
        row = row_type(*(value(where, name, named[name], words, texts, needs) for name in row_type._fields))
        if check:
            check(where, row)
        yield row


def value(where, name, text, words, texts, needs):
    if not text and name in needs:
        raise Malformed("{}, column {}: is empty".format(where, name))
    if name in words and text not in words[name]:
        raise Malformed("{}, column {}: {!r} is none of {}".format(where, name, text, ", ".join(words[name])))
    if name in words or name in texts:
        return text
    return number(where, name, text)


def number(where, name, text):
    if not text:
        return None
    try:
        read_number = float(text)
    except ValueError:
        read_number = math.nan
    if not math.isfinite(read_number):
        raise Malformed("{}, column {}: {!r} is not a finite number".format(where, name, text))
    return read_number


def check_run(where, run):
    """What a logarithmic axis shows is above 0, and a run that went well has what is charted of it."""
    for name in ("value", "rms_error", "seconds_per_second"):
        there = getattr(run, name)
        if there is not None and there <= 0.0:
            raise Malformed("{}, column {}: {:g} is not above 0".format(where, name, there))
    charted = ("rms_error",) if run.kind == "spatial" else ("rms_error", "seconds_per_second")
    for name in charted:
        if run.status == "ok" and getattr(run, name) is None:
            raise Malformed("{}, column {}: is empty, but the run is ok".format(where, name))


def check_together(path, scenes, runs):
    known = {(scene.scene, scene.kind) for scene in scenes}
    seen = set()
    for run in runs:
        which = "{}: {} with {} {:g}".format(run.scene, run.solver, run.setting, run.value)
        if (run.scene, run.kind) not in known:
            raise Malformed("{}: {}: scenes.csv has no such scene of kind {}".format(path, which, run.kind))
        key = (run.scene, run.kind, run.solver, run.setting, run.value)
        if key in seen:
            raise Malformed("{}: {}, kind {}: is there twice".format(path, which, run.kind))
        seen.add(key)
