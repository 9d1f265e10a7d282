"""What build.py promises: no number is typed, none is missing.  usage: python3 -m unittest discover paper"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import build

RESULTS = build.ROOT / "results"


def typed(text):
    return build.typed_numbers("#let width = 12.5\n*Abstract.* " + text)


def built(results):
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, build.__file__, "--results", results, "--output", Path(folder) / "paper.pdf"]
        return subprocess.run(command, capture_output=True, text=True)


class TypedNumbers(unittest.TestCase):
    def test_results_are_found_wherever_they_stand(self):
        for text in ["It falls by 3.5 %.", "An error of $1.2 dot 10^(-5)$.", "#num(x) of 1089 vertices.", "after 44 steps", "#figure(picture(\"a.svg\", width: 62%), caption: [Of 71 #num(x) faces [sic].])"]:
            self.assertEqual(len(typed(text)), 2 if "10^" in text else 1, text)

    def test_what_is_read_or_no_result_is_not(self):
        for text in [
            '#num(val("riemann", ("config.surface.parameters.n": 64), "result.error.max"), digits: 12) and @cite2013',
            "$d_(02) = v_2 - v_0$, order 2, of 2013, section 2.3 there, `n = 33`, <label-77>",
            "// 99 in a comment",
        ]:
            self.assertEqual(typed(text), [], text)

    def test_the_paper_has_none(self):
        self.assertEqual(build.typed_numbers(build.SOURCE.read_text(encoding="utf-8")), [])


class MissingRecords(unittest.TestCase):
    def test_a_missing_experiment_or_value_ends_the_build_with_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            results = Path(folder) / "results"
            shutil.copytree(RESULTS, results)
            path = results / "energies" / "records.jsonl"
            records = build.lines(path)
            for record in records:
                del record["result"]["distortion"]
            path.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
            ran = built(results)
            self.assertNotEqual(ran.returncode, 0)
            self.assertIn("no `result.distortion", ran.stderr.replace("has a number", "no"))
            shutil.rmtree(results / "energies")
            ran = built(results)
            self.assertNotEqual(ran.returncode, 0)
            self.assertIn("no results of the experiment `energies`: riemap reproduce energies", ran.stderr)


if __name__ == "__main__":
    unittest.main()
