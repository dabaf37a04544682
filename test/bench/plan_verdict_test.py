"""The verdict on plans: what counts as good, and when a criterion holds."""

import os
import subprocess
import sys
import tempfile
import unittest

import synthetic_plans as synthetic
from plan_matrix import report, tables, verdict
from work_precision.runs import Malformed

PROGRAM = os.path.join(os.path.dirname(__file__), "..", "..", "bench", "plot_plan_matrix.py")


def half_of(plans, parts=(), draws=None, build=None):
    with tempfile.TemporaryDirectory() as folder:
        synthetic.write(folder, plans, parts, draws)
        return tables.read(folder, build)[0]


def judged(name, plans, parts=(), draws=None):
    return next(found for found in verdict.criteria(half_of(plans, parts, draws)) if found.name == name)


def good(count):
    return [synthetic.plan("{:03d}".format(number)) for number in range(count)]


class Shares(unittest.TestCase):
    def expect(self, name, bad, needed):
        """`bad` is one plan; among 1/(1 - needed) plans it is just bearable, among one fewer it is not."""
        enough = round(1.0 / (1.0 - needed))
        borne = judged(name, good(enough - 1) + [bad])
        self.assertEqual(len(verdict.failing(borne)), 1)
        self.assertTrue(verdict.holds(borne))
        self.assertFalse(verdict.holds(judged(name, good(enough - 2) + [bad])))

    def test_honest(self):
        self.expect("honest", synthetic.plan("bad", true_error=1.001e-3), 0.95)
        self.expect("honest", synthetic.plan("bad", status="unstable", true_error=""), 0.95)
        self.expect("honest", synthetic.plan("bad", status="refused", true_error="", estimate="", message="no"), 0.95)

    def test_estimate(self):
        self.expect("estimate", synthetic.plan("bad", estimate=0.14e-3), 0.9)
        self.expect("estimate", synthetic.plan("bad", estimate=1.6e-3), 0.9)
        self.expect("estimate", synthetic.plan("bad", estimate=""), 0.9)

    def test_cheap(self):
        self.expect("cheap", synthetic.plan("bad", cost=15.1, best_cost=10.0), 0.9)
        self.expect("cheap", synthetic.plan("bad", estimate=2e-3), 0.9)
        self.expect("cheap", synthetic.plan("bad", status="too_slow", true_error=""), 0.9)

    def test_planning(self):
        self.expect("planning", synthetic.plan("bad", cost=2.0, planning=2.0), 0.9)

    def test_start(self):
        self.expect("start", synthetic.plan("bad", planning_seconds=1.0), 0.9)


class Cases(unittest.TestCase):
    def test_a_plan_that_says_that_it_misses_is_not_dishonest(self):
        plans = good(1) + [synthetic.plan("bad", estimate=2e-3, true_error=2e-3)]
        self.assertEqual(len(judged("honest", plans).cases), 1)

    def test_where_nothing_meets_the_tolerance_nothing_is_too_dear(self):
        plans = good(1) + [synthetic.plan("bad", best_solver="", best_cost="")]
        self.assertEqual(len(judged("cheap", plans).cases), 1)

    def test_errors_that_the_reference_cannot_tell_are_no_estimates(self):
        plans = good(1) + [synthetic.plan("fine", true_error=4e-8, estimate=1e-3)]
        self.assertEqual(len(judged("estimate", plans).cases), 1)
        plans = good(1) + [synthetic.plan("fine", true_error=6e-8, estimate=1e-3)]
        self.assertEqual(len(judged("estimate", plans).cases), 2)

    def test_a_looser_tolerance_that_costs_more_is_not_monotone(self):
        def pair(loose, tight, **fields):
            return judged("monotone", [synthetic.plan("a", 1e-2, cost=loose, **fields),
                                       synthetic.plan("a", 1e-3, cost=tight, **fields)])
        self.assertTrue(verdict.holds(pair(1.09, 1.0)))
        self.assertFalse(verdict.holds(pair(1.11, 1.0)))
        self.assertTrue(verdict.holds(pair(1.5, 1.0, time_step=1e-3)), "the same choice")

    def test_a_plan_that_misses_its_tolerance_does_not_say_what_that_costs(self):
        plans = [synthetic.plan("a", 1e-2, cost=9.0), synthetic.plan("a", 1e-3, cost=1.0, estimate=2e-3, true_error=2e-3)]
        self.assertIsNone(verdict.holds(judged("monotone", plans)))

    def test_a_tolerance_that_the_method_does_not_read_is_no_other_choice(self):
        def pair(method):
            return judged("monotone", [
                synthetic.plan("a", tolerance, method=method, time_step=1e-3, cost=100.0 * tolerance)
                for tolerance in (1e-2, 1e-3)])
        self.assertTrue(verdict.holds(pair("rk4")))
        self.assertFalse(verdict.holds(pair("dopri5")))

    def test_parts_are_necessary_both_ways(self):
        def fails(name, change, is_left_out):
            return bool(verdict.failing(judged(name, good(1), [synthetic.part("000", change, is_left_out)])))
        self.assertFalse(fails("left out", 0.99e-3, "yes"))
        self.assertTrue(fails("left out", 1.01e-3, "yes"))
        self.assertTrue(fails("left out", "", "yes"))
        self.assertFalse(fails("kept", 0.26e-3, "no"))
        self.assertTrue(fails("kept", 0.24e-3, "no"))

    def test_nothing_to_judge_is_no_success(self):
        self.assertIsNone(verdict.holds(judged("left out", good(1))))


class Tables(unittest.TestCase):
    def test_the_last_build_counts_unless_another_is_given(self):
        plans = [synthetic.plan("000", build="b1"), synthetic.plan("000", build="b2", cost=9.0)]
        self.assertEqual([plan.cost for plan in half_of(plans).plans], [9.0])
        self.assertEqual([plan.build for plan in half_of(plans, build="b1").plans], ["b1"])
        with self.assertRaisesRegex(Malformed, "no plan is of build b3; there are b1, b2"):
            half_of(plans, build="b3")

    def test_a_bad_number_is_named(self):
        with self.assertRaisesRegex(Malformed, "plans.csv, line 2, column cost: 'dear' is not a finite number"):
            half_of([synthetic.plan("000", cost="dear")])


class Report(unittest.TestCase):
    def test_says_what_holds_what_fails_and_what_was_replaced(self):
        draws = [synthetic.draw("000", accepted="no", reason="too costly"), synthetic.draw("000_1")]
        half = half_of([synthetic.plan("000_1", true_error=2e-3)], draws=draws)
        text = "\n".join(report.sections([half]))
        self.assertIn("| honest | true error within the tolerance | 0.0 % of 1 | 95 % | **fails** |", text)
        self.assertIn("| cheap | costs at most 1.5 times the best of the search | 100.0 % of 1 | 90 % | holds |", text)
        self.assertIn("Not honest: 000_1 at 1e-3 m (2).", text)
        self.assertIn("Draws that were replaced: 1.", text)
        self.assertIn("- 000 (9 x 8 nodes): too costly", text)
        self.assertIn("Chosen: rk4 1. Best of the search: rk4 1.", text)


class Program(unittest.TestCase):
    def run_program(self, *words):
        return subprocess.run([sys.executable, "-B", PROGRAM] + list(words), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, check=False)

    def test_judges_without_charts(self):
        with tempfile.TemporaryDirectory() as folder:
            synthetic.write(folder, good(2))
            done = self.run_program(folder, "--no-charts")
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual(sorted(os.listdir(folder)), ["development", "verdict.md"])

    def test_draws_the_halves_side_by_side(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("python3-matplotlib is missing")
        with tempfile.TemporaryDirectory() as folder:
            parts = [synthetic.part("000", 1e-4, "yes"), synthetic.part("000", 1e-2, "no", name="flex springs")]
            for half in tables.HALVES:
                synthetic.write(folder, good(2), parts, half=half, draws=[synthetic.draw("000", half=half)])
            out = os.path.join(folder, "out")
            done = self.run_program(folder, out)
            self.assertEqual((done.returncode, done.stdout.count("honest")), (0, 2), done.stdout)
            charts = ("honest", "cheap", "planning", "monotone", "necessary")
            self.assertEqual(sorted(os.listdir(out)), sorted(
                ["verdict.md"] + [name + ending for name in charts for ending in (".png", ".svg")]))

    def test_says_where_there_is_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_program(folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("neither development/plans.csv nor held_out/plans.csv", done.stdout)


if __name__ == "__main__":
    unittest.main()
