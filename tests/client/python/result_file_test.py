"""result.json, written and read."""
import dataclasses
import json

import jsonschema
import numpy

import capfit
from support import ROOT, ServerTest, run_capfit

SCHEMA = ROOT / "docs" / "result.schema.json"
ALL = {"parts": "all", "skinning": "dense", "want_vertex_gaps": True,
       "want_feature_polygons": True, "request_id": "job 7"}


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def without_times(document):
    """All members that are the same for each run."""
    return {name: value for name, value in document.items() if name not in ("stages", "seconds")}


class ResultFileTest(ServerTest):
    """Result.to_json and Result.load."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.result = cls.client.approximate(cls.body, **ALL)

    def written(self, result, name="result.json"):
        path = self.scratch / name
        result.to_json(path)
        return path

    def test_load_gives_the_result_back(self):
        loaded = capfit.Result.load(self.written(self.result))
        for member in dataclasses.fields(capfit.Result):
            wanted, got = getattr(self.result, member.name), getattr(loaded, member.name)
            if isinstance(wanted, numpy.ndarray):
                numpy.testing.assert_array_equal(got, wanted, member.name)
                self.assertEqual(got.dtype, wanted.dtype)
            elif member.name not in ("body_from_caller", "feature_polygons"):
                self.assertEqual(got, wanted, member.name)
        frame, wanted = loaded.body_from_caller, self.result.body_from_caller
        numpy.testing.assert_array_equal(frame.rotation, wanted.rotation)
        self.assertEqual(frame.scale, wanted.scale)
        self.assertEqual(len(loaded.feature_polygons), len(self.result.feature_polygons))
        for polygon, wanted in zip(loaded.feature_polygons, self.result.feature_polygons):
            numpy.testing.assert_array_equal(polygon.outline, wanted.outline)
            numpy.testing.assert_array_equal(polygon.circles, wanted.circles)
        numpy.testing.assert_allclose(
            loaded.apply(self.vertices), self.result.spheres[:, :3], rtol=0, atol=1e-6)

    def test_the_schema_holds(self):
        schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
        plain = self.client.approximate(self.body)
        for result in (self.result, plain):
            jsonschema.validate(read(self.written(result, "checked.json")), schema)

    def test_it_is_the_file_of_the_command_line(self):
        path = self.scratch / "command_line.json"
        run_capfit("approximate", self.body, "-o", path, "--server", self.address, "--quiet",
                   "--parts", "all", "--skinning", "dense", "--heat-map", "--polygons",
                   "--request-id", "job 7")
        ours = self.written(self.result, "ours.json")
        self.assertEqual(list(read(ours)), list(read(path)))
        for name, wanted in without_times(read(path)).items():
            self.assertEqual(read(ours)[name], wanted, name)
        for ending in ("weights", "gaps"):
            wanted = read(path.with_suffix(f".{ending}.json"))
            self.assertEqual(read(ours.with_suffix(f".{ending}.json")),
                             {**wanted, "data": f"ours.{ending}.f32"})
            self.assertEqual(ours.with_suffix(f".{ending}.f32").read_bytes(),
                             path.with_suffix(f".{ending}.f32").read_bytes())
        numpy.testing.assert_array_equal(capfit.Result.load(path).weights, self.result.weights)

    def test_what_is_no_result_is_refused(self):
        document = read(self.written(self.result))
        without = {name: value for name, value in document.items() if name != "capsules"}
        for problem, text in {
                "is no JSON object": "[1]",
                "format is None, must be 'capfit-result'": "{}",
                "format version 2": json.dumps({**document, "format_version": 2}),
                "has no member 'capsules'": json.dumps(without),
                "is no result": json.dumps({**document, "spheres": [[1, 2, 3]]}),
                "Expecting value": "{",
        }.items():
            path = self.scratch / "wrong.json"
            path.write_text(text if text != "{" else '{"a": ')
            with self.subTest(problem), self.assertRaisesRegex(ValueError, problem):
                capfit.Result.load(path)
        with self.assertRaises(FileNotFoundError):
            capfit.Result.load(self.scratch / "nowhere.json")

    def test_weights_of_another_result_are_refused(self):
        path = self.written(self.result, "mixed.json")
        header = path.with_suffix(".weights.json")
        header.write_text(json.dumps({**read(header), "spheres": 1}))
        with self.assertRaisesRegex(ValueError, r"spheres is 1, must be \d+ to belong to mixed"):
            capfit.Result.load(path)

    def test_too_few_numbers_are_refused(self):
        path = self.written(self.result, "short.json")
        data = path.with_suffix(".gaps.f32")
        data.write_bytes(data.read_bytes()[:-4])
        with self.assertRaisesRegex(ValueError, r"short.gaps.f32 holds \d+ numbers, must hold"):
            capfit.Result.load(path)

    def test_weights_that_are_gone_are_none(self):
        path = self.written(self.result, "alone.json")
        for ending in ("weights", "gaps"):
            path.with_suffix(f".{ending}.json").unlink()
        loaded = capfit.Result.load(path)
        self.assertIsNone(loaded.weights)
        self.assertIsNone(loaded.vertex_gaps)
