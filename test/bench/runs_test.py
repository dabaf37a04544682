"""Reading the CSV files: what is there, and clear errors of what is not as it should be."""

import os
import tempfile
import unittest

import synthetic_runs as synthetic
from work_precision.runs import Malformed, read


class Reading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.rows = [synthetic.run("rk4", "step", 1e-2, status="unstable"),
                     synthetic.good_run("rk4", "step", 5e-3, 1e-4, 0.25)]
        self.scenes = [synthetic.scene(reason='"asymmetric", smooth')]

    def read(self):
        synthetic.write(self.folder, self.scenes, self.rows)
        return read(self.folder)

    def edit(self, file, old, new):
        synthetic.write(self.folder, self.scenes, self.rows)
        path = os.path.join(self.folder, file)
        with open(path, encoding="utf-8") as source:
            text = source.read()
        self.assertIn(old, text)
        with open(path, "w", encoding="utf-8") as target:
            target.write(text.replace(old, new, 1))

    def fault(self):
        with self.assertRaises(Malformed) as caught:
            read(self.folder)
        return str(caught.exception)

    def assert_fault(self, *parts):
        synthetic.write(self.folder, self.scenes, self.rows)
        fault = self.fault()
        for part in parts:
            self.assertIn(part, fault)

    def test_reads_numbers_words_and_what_does_not_apply(self):
        (scene,), (unstable, good) = self.read()
        self.assertEqual(scene.reason, '"asymmetric", smooth')
        self.assertEqual(scene.growth, 300.0)
        self.assertEqual((unstable.status, unstable.rms_error, unstable.seconds_per_second), ("unstable", None, None))
        self.assertEqual((good.solver, good.value, good.rms_error, good.nodes), ("rk4", 5e-3, 1e-4, 1024.0))

    def test_lets_further_columns_be(self):
        synthetic.write_table(os.path.join(self.folder, "scenes.csv"), synthetic.SCENE_COLUMNS, self.scenes)
        rows = [dict(row, momentum="1e-12") for row in self.rows]
        synthetic.write_table(os.path.join(self.folder, "runs.csv"), ["momentum"] + synthetic.RUN_COLUMNS, rows)
        self.assertEqual(read(self.folder)[1][1].rms_error, 1e-4)

    def test_names_a_missing_column(self):
        self.edit("runs.csv", ",rms_error,", ",error,")
        self.assertIn("runs.csv, line 1: no column rms_error", self.fault())

    def test_names_line_and_column_of_what_is_no_number(self):
        for text in ("fast", "nan", "inf", "1,5"):
            with self.subTest(text):
                self.rows[1]["seconds_per_second"] = text
                self.assert_fault(
                    "runs.csv, line 3, column seconds_per_second: '{}' is not a finite number".format(text))

    def test_names_what_is_allowed(self):
        self.rows[1]["status"] = "fine"
        self.assert_fault("runs.csv, line 3, column status: 'fine' is none of ok, unstable, not_converged, too_slow")

    def test_names_line_of_scenes(self):
        self.scenes[0]["accepted"] = "maybe"
        self.assert_fault("scenes.csv, line 2, column accepted: 'maybe' is none of yes, no")

    def test_refuses_a_line_with_a_field_too_few(self):
        self.edit("runs.csv", ",abc1234", "")
        self.assertIn("runs.csv, line 2: 22 fields, but the header has 23", self.fault())

    def test_refuses_an_empty_name(self):
        self.rows[0]["solver"] = ""
        self.assert_fault("runs.csv, line 2, column solver: is empty")

    def test_refuses_what_a_logarithmic_axis_cannot_show(self):
        self.rows[1]["rms_error"] = 0.0
        self.assert_fault("runs.csv, line 3, column rms_error: 0 is not above 0")

    def test_refuses_a_good_run_without_error(self):
        self.rows[1]["rms_error"] = ""
        self.assert_fault("runs.csv, line 3, column rms_error: is empty, but the run is ok")

    def test_refuses_a_run_that_is_there_twice(self):
        self.rows.append(dict(self.rows[1]))
        self.assert_fault("sheet: rk4 with step 0.005", "twice")

    def test_refuses_a_run_of_a_scene_that_is_not_there(self):
        self.rows[1]["scene"] = "tent"
        self.assert_fault("tent: rk4 with step 0.005: scenes.csv has no such scene of kind trajectory")

    def test_names_a_file_that_is_not_there(self):
        self.assertIn("scenes.csv", self.fault())


if __name__ == "__main__":
    unittest.main()
