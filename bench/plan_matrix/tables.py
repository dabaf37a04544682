"""The tables of one half of a matrix, read and checked."""

import os
from collections import namedtuple

from work_precision.runs import Malformed, read_table

HALVES = ("development", "held_out")
YES_NO = ("yes", "no")
STATUSES = ("ok", "unstable", "not_converged", "too_slow", "refused")

DRAW_COLUMNS = "scene half accepted rows cols node_steps reference_error growth reason".split()
PLAN_COLUMNS = (
    "build commit scene fingerprint tolerance status method time_step method_tolerance iterations left_out estimate "
    "true_error worst_error estimated_cost seconds_per_second cost planning_seconds planning best_solver best_setting "
    "best_value best_error best_cost message").split()
PART_COLUMNS = "build scene fingerprint tolerance part is_left_out change".split()

Draw = namedtuple("Draw", DRAW_COLUMNS)
Plan = namedtuple("Plan", PLAN_COLUMNS)
Part = namedtuple("Part", PART_COLUMNS)
Half = namedtuple("Half", "name draws plans parts")

PLAN_TEXTS = ("build commit scene fingerprint method left_out best_solver best_setting message").split()
PART_TEXTS = ("build", "scene", "fingerprint", "part")


def read(folder, build=None):
    """The halves that are there, with the plans of one build: the one given, or that which planned last."""
    return [read_half(folder, name, build) for name in HALVES
            if os.path.exists(os.path.join(folder, name, "plans.csv"))]


def read_half(folder, name, build):
    def path(table):
        return os.path.join(folder, name, table)
    draws = read_table(path("scenes.csv"), Draw, {"half": HALVES, "accepted": YES_NO}, ("scene", "reason"),
                       ("scene", "half", "accepted"))
    plans = read_table(path("plans.csv"), Plan, {"status": STATUSES}, PLAN_TEXTS, ("build", "scene", "status"))
    parts = read_table(path("parts.csv"), Part, {"is_left_out": YES_NO}, PART_TEXTS, ("build", "scene", "part"))
    if not plans:
        raise Malformed("{}: there are no plans".format(path("plans.csv")))
    chosen = build or plans[-1].build
    known = sorted({plan.build for plan in plans})
    if chosen not in known:
        raise Malformed("{}: no plan is of build {}; there are {}".format(path("plans.csv"), chosen, ", ".join(known)))
    return Half(name, draws, [plan for plan in plans if plan.build == chosen],
                [part for part in parts if part.build == chosen])
