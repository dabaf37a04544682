#!/usr/bin/env python3
"""Runs the tests in Python beside this file.

    test/bench/run.py [RESULTS.xml]

RESULTS.xml gets what each test came to, in the form of JUnit. Exit status 1 when one failed.
"""

import os
import sys
import time
import unittest
import xml.etree.ElementTree as xml

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "..", "..", "bench"))


class Results(unittest.TextTestResult):
    """Also keeps one JUnit element a test; a subtest that fails counts against its test."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.cases = {}
        self.began = {}

    def startTest(self, test):
        super().startTest(test)
        self.began[test.id()] = time.monotonic()
        self.case(test)

    def stopTest(self, test):
        super().stopTest(test)
        self.case(test).set("time", "{:.3f}".format(time.monotonic() - self.began[test.id()]))

    def case(self, test):
        """Of whatever is reported on: a failing setUpClass has no startTest."""
        group, _, name = test.id().rpartition(".")
        return self.cases.setdefault(test.id(), xml.Element("testcase", classname=group, name=name))

    def mark(self, test, tag, text):
        element = xml.SubElement(self.case(test), tag, message=text.strip().splitlines()[-1])
        element.text = text

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.mark(test, "failure", self.failures[-1][1])

    def addError(self, test, err):
        super().addError(test, err)
        self.mark(test, "error", self.errors[-1][1])

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err is not None:
            self.mark(test, "failure", "{}\n{}".format(subtest, self._exc_info_to_string(err, test)))

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.mark(test, "skipped", reason)


def main():
    tests = unittest.defaultTestLoader.discover(HERE, pattern="*_test.py", top_level_dir=HERE)
    results = unittest.TextTestRunner(resultclass=Results, stream=sys.stdout).run(tests)
    for test, reason in results.skipped:
        print("skipped {}: {}".format(test, reason))
    if len(sys.argv) > 1:
        write(sys.argv[1], list(results.cases.values()))
    return 0 if results.wasSuccessful() and results.testsRun > 0 else 1


def write(path, cases):
    def count(tag):
        return str(sum(case.find(tag) is not None for case in cases))
    suite = xml.Element("testsuite", name="charts", tests=str(len(cases)), failures=count("failure"),
                        errors=count("error"), skipped=count("skipped"))
    suite.extend(cases)
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    xml.ElementTree(suite).write(path, encoding="utf-8", xml_declaration=True)


if __name__ == "__main__":
    sys.exit(main())
