"""The package against a real server."""
import importlib.metadata
import pathlib
import pickle
import tempfile
import threading

import numpy

import capfit
from capfit.v1 import error_pb2
from support import ServerTest

STAGES = ["mesh", "body", "section", "circle", "capsule", "refine", "coverage", "metrics",
          "skinning"]


def distances(points, result):
    """From points (n, 3) to the surface of the union, negative inside."""
    spheres = result.spheres
    best = numpy.full(len(points), numpy.inf)
    for x, y, z, r in spheres:
        best = numpy.minimum(best, numpy.linalg.norm(points - (x, y, z), axis=1) - r)
    for a, b in result.capsules:
        best = numpy.minimum(best, hull_distances(points, spheres[a], spheres[b]))
    return best


def hull_distances(points, first, second):
    """To the convex hull of two spheres, for points beside its cone; else infinity."""
    axis = second[:3] - first[:3]
    length = numpy.linalg.norm(axis)
    sine = (first[3] - second[3]) / length
    if abs(sine) >= 1:
        return numpy.full(len(points), numpy.inf)
    cosine = numpy.sqrt(1 - sine * sine)
    along = (points - first[:3]) @ (axis / length)
    beside = numpy.linalg.norm(points - first[:3] - numpy.outer(along, axis / length), axis=1)
    foot = along - beside * sine / cosine  # where the cone's normal meets the axis
    on_cone = (foot > 0) & (foot < length)
    return numpy.where(on_cone, beside * cosine + along * sine - first[3], numpy.inf)


class FitTest(ServerTest):
    """What comes back."""

    def test_file_gives_arrays_and_what_is_known_of_each_sphere(self):
        result = self.client.approximate(str(self.body), max_primitives=40, parts="all")
        count = len(result.spheres)
        self.assertEqual((result.spheres.dtype, result.spheres.shape), (numpy.float64, (count, 4)))
        self.assertEqual(result.capsules.dtype, numpy.int32)
        self.assertEqual(result.capsules.shape, (len(result.capsules), 2))
        self.assertTrue(10 < count + len(result.capsules) <= 40)
        self.assertEqual(result.metrics.primitive_count, count + len(result.capsules))
        self.assertTrue((result.capsules[:, 0] < result.capsules[:, 1]).all())
        self.assertEqual(len(set(result.sphere_names)), count)
        self.assertEqual(set(result.sphere_parts), set(result.metrics.parts))
        self.assertEqual(len(result.metrics.parts), 10)
        self.assertEqual(len(result.capsule_parts), len(result.capsules))
        for index, mirror in enumerate(result.sphere_mirrors):
            self.assertEqual(result.sphere_mirrors[mirror], index)
        self.assertIsNone(result.sphere_polygons)
        self.assertIsNone(result.feature_polygons)
        self.assertIsNone(result.weights)
        wrist = result.landmarks["left_wrist"]
        self.assertEqual(wrist.method, "measured")
        self.assertTrue(0 < wrist.confidence <= 1)
        self.assertGreater(wrist.position[0], 0.2)

    def test_gaps_are_the_distances_to_the_set_and_nothing_is_outside(self):
        result = self.client.approximate(self.body, parts="all", want_vertex_gaps=True)
        self.assertEqual(result.vertex_gaps.dtype, numpy.float32)
        self.assertLess(result.vertex_gaps.max(), 1e-4)
        numpy.testing.assert_array_less(distances(self.vertices, result), 1e-4)
        outside = self.vertices * 1.5
        self.assertGreater(distances(outside, result).max(), 0.1)

    def test_arrays_give_the_same_bits_as_the_file(self):
        wanted = self.client.approximate(self.body)
        quads = numpy.array(self.faces)
        for faces in (self.faces, quads, quads.astype(numpy.uint32), list(quads)):
            result = self.client.approximate(vertices=self.vertices, faces=faces)
            numpy.testing.assert_array_equal(result.spheres, wanted.spheres)
            numpy.testing.assert_array_equal(result.capsules, wanted.capsules)
            self.assertEqual(result.body, wanted.body)

    def test_faces_may_be_triangles_or_a_mixture(self):
        quads = numpy.array(self.faces)
        triangles = numpy.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        mixed = self.faces[1:] + [self.faces[0][:3], [self.faces[0][i] for i in (0, 2, 3)]]
        for faces, count in ((triangles, 2 * len(quads)), (mixed, len(quads) + 1)):
            result = self.client.approximate(vertices=self.vertices, faces=faces)
            self.assertEqual(result.body.face_count, count)
            self.assertEqual(result.body.vertex_count, len(self.vertices))
            self.assertEqual(result.warnings, [])

    def test_single_precision_goes_as_such(self):
        wanted = self.client.approximate(
            vertices=self.vertices.astype(numpy.float32).astype(numpy.float64), faces=self.faces)
        result = self.client.approximate(
            vertices=self.vertices.astype(numpy.float32), faces=self.faces)
        numpy.testing.assert_array_equal(result.spheres, wanted.spheres)

    def test_bytes_of_a_file(self):
        data = self.body.read_bytes()
        wanted = self.client.approximate(self.body).spheres
        for name in ("auto", "obj", "OBJ"):
            result = self.client.approximate(data, file_format=name)
            numpy.testing.assert_array_equal(result.spheres, wanted)
        self.assertEqual(self.failing(data, file_format="glb").reason, "MALFORMED_FILE")

    def test_weights_reproduce_and_carry_the_centres(self):
        result = self.client.approximate(self.body, skinning="dense")
        self.assertEqual(result.weights.shape, (len(result.spheres), len(self.vertices)))
        self.assertEqual(result.weights.dtype, numpy.float32)
        centers = result.spheres[:, :3]
        numpy.testing.assert_allclose(result.apply(self.vertices), centers, rtol=0, atol=1e-6)
        turn = numpy.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        frames = numpy.stack([self.vertices, self.vertices @ turn.T + [1000, 2000, 3000]])
        moved = result.apply(frames)
        self.assertEqual(moved.shape, (2, len(centers), 3))
        numpy.testing.assert_allclose(moved[1], centers @ turn.T + [1000, 2000, 3000], atol=1e-6)
        with self.assertRaisesRegex(ValueError, r"of shape \(5, 3\), must be \(\d+, 3\)"):
            result.apply(self.vertices[:5])

    def test_sparse_weights_carry_the_centres_and_survive_the_file(self):
        result = self.client.approximate(self.body, skinning="sparse")
        self.assertIsNone(result.weights)
        centers = result.spheres[:, :3]
        numpy.testing.assert_allclose(result.apply(self.vertices), centers, rtol=0, atol=1e-8)
        frames = numpy.stack([self.vertices, 2 * self.vertices + 1000])
        numpy.testing.assert_allclose(result.apply(frames)[1], 2 * centers + 1000, atol=1e-6)
        self.assertLessEqual(max(len(row.vertices) for row in result.sparse_weights), 128)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "result.json"
            result.to_json(path)
            numpy.testing.assert_array_equal(capfit.Result.load(path).apply(frames),
                                             result.apply(frames))

    def test_bones_of_a_body_without_any_are_refused(self):
        error = self.failing(self.body, skinning="bones")
        self.assertEqual((error.reason, error.field), ("CONFLICT", "options.skinning"))

    def test_centres_without_weights_say_what_to_ask_for(self):
        result = self.client.approximate(self.body)
        with self.assertRaisesRegex(ValueError, 'skinning="sparse"'):
            result.apply(self.vertices)
        with self.assertRaisesRegex(ValueError, 'skinning="bones"'):
            result.apply_joints(numpy.zeros((0, 3, 4)))

    def test_feature_polygons_lie_in_a_plane_with_their_circles(self):
        result = self.client.approximate(self.body, want_feature_polygons=True)
        self.assertGreater(len(result.feature_polygons), 5)
        polygon = result.feature_polygons[0]
        points = numpy.concatenate([polygon.outline, polygon.circles[:, :3]])
        flat = numpy.linalg.svd(points - points.mean(axis=0), compute_uv=False)
        self.assertLess(flat[2], 1e-6)
        used = {index for index in result.sphere_polygons if index is not None}
        self.assertTrue(used and max(used) < len(result.feature_polygons))

    def test_metres_of_a_body_in_centimetres(self):
        result = self.client.approximate(vertices=100 * self.vertices, faces=self.faces)
        self.assertEqual((result.unit, result.up_axis), ("centimetre", "y"))
        self.assertAlmostEqual(result.metres_per_unit, 0.01)
        metres = result.body_from_caller(100 * self.vertices)
        self.assertAlmostEqual(metres[:, 1].min(), 0, places=6)
        self.assertAlmostEqual(numpy.ptp(metres[:, 1]), result.body.height_m, places=6)

    def test_every_option_arrives(self):
        options = self.client.approximate(
            self.body, unit="m", up_axis="Y", max_spheres=60, max_capsules=70, engine="nvcloth",
            parts="torso, arms legs,head", require_parts=["arms"], fit_mode="enclose",
            quality="Tight", tolerance_m=0.002, sex="female", skinning="dense",
            landmarks={"crotch": (0, 0.75, 0)}, seed=2**64 - 1, want_feature_polygons=False,
            want_vertex_gaps=True, include_hair=True).options
        self.assertEqual(options, {
            "budget": {"max_spheres": 32, "max_capsules": 32}, "fit_mode": "enclose",
            "quality": "tight", "parts": ["torso", "arms", "legs", "head"],
            "require_parts": ["arms"], "sex": "female", "skinning": "dense", "seed": 2**64 - 1,
            "tolerance_m": 0.002, "engine": "nvcloth", "capsule_profile": "tangent_hull",
            "unit": "metre", "up_axis": "y", "caller_landmark_count": 1,
            "want_feature_polygons": False, "want_vertex_gaps": True, "include_parts": [],
            "exclude_parts": [], "include_hair": True, "include_skirt": False,
            "layout": ""})
        for budget in ({"max_primitives": 33}, {"max_polygon_error": 0.25}, {"max_spheres": 30}):
            self.assertEqual(self.client.approximate(self.body, **budget).options["budget"], budget)

    def test_a_layout_is_kept_by_name_and_from_a_result(self):
        first = self.client.approximate(self.body, layout="standard-32")
        self.assertEqual((len(first.spheres), len(first.capsules)), (32, 32))
        self.assertEqual(first.options["layout"], "standard-32")
        self.assertEqual(first.options["parts"],
                         ["torso", "arms", "legs", "head", "hands", "feet"])
        second = self.client.approximate(vertices=1.1 * self.vertices, faces=self.faces,
                                         parts="all", layout=first)
        self.assertEqual(second.options["layout"], "own")
        self.assertEqual(second.sphere_names, first.sphere_names)
        self.assertEqual(second.capsules.tolist(), first.capsules.tolist())
        self.assertEqual(second.metrics.vertices_out, 0)

    def test_files_for_engines_come_with_the_answer(self):
        result = self.client.approximate(self.body, exports="unity, csv, gltf")
        self.assertLess({"unity_colliders.json", "spheres.csv", "capsules.csv"},
                        set(result.exports))
        lines = result.exports["spheres.csv"].decode().splitlines()
        rows = [line for line in lines if not line.startswith("#")]
        self.assertEqual(len(rows), 1 + len(result.spheres))
        glb = next(data for name, data in result.exports.items() if name.endswith(".glb"))
        self.assertEqual(glb[:4], b"glTF")
        with self.assertRaises(capfit.CapfitError) as caught:
            self.client.approximate(self.body, exports=["fbx"])
        self.assertEqual(caught.exception.field, "exports[0].format")

    def test_words_of_the_command_line_and_of_the_file_mean_the_same(self):
        for word in ("best", "best_fit", "BEST-FIT"):
            options = self.client.approximate(self.body, fit_mode=word).options
            self.assertEqual(options["fit_mode"], "best_fit")
        # What a result says can be asked for again.
        again = self.client.approximate(self.body, parts=options["parts"], unit=options["unit"],
                                        fit_mode=options["fit_mode"], up_axis=options["up_axis"])
        self.assertEqual(again.options, options)

    def test_landmarks_of_a_result_go_in_again(self):
        first = self.client.approximate(self.body)
        wrist = {"left_wrist": first.landmarks["left_wrist"]}
        second = self.client.approximate(self.body, landmarks=wrist)
        self.assertEqual(second.landmarks["left_wrist"].method, "caller")
        numpy.testing.assert_allclose(second.landmarks["left_wrist"].position,
                                      wrist["left_wrist"].position, rtol=0, atol=1e-9)

    def test_progress_never_falls(self):
        seen = []
        self.client.approximate(self.body, quality="tight",
                                on_progress=lambda stage, done: seen.append((stage, done)))
        self.assertTrue({stage for stage, _ in seen} <= set(STAGES))
        self.assertGreater(len(seen), 2)
        fractions = [done for _, done in seen]
        self.assertEqual(fractions, sorted(fractions))

    def test_an_exception_of_the_callback_ends_the_call_and_not_the_client(self):
        def fail(*_):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            self.client.approximate(self.body, on_progress=fail)
        self.assertGreater(len(self.client.approximate(self.body).spheres), 5)

    def test_threads_may_share_a_client(self):
        sets = []
        threads = [threading.Thread(
            target=lambda: sets.append(self.client.approximate(self.body).spheres))
            for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(sets), 4)
        for spheres in sets:
            numpy.testing.assert_array_equal(spheres, sets[0])

    def test_server_info(self):
        info = self.client.server_info()
        self.assertEqual(info.version, importlib.metadata.version("capfit"))
        self.assertIn("obj", info.formats)
        self.assertIn("quality.tight", info.features)
        self.assertIn("quality.balanced", info.features)
        self.assertGreater(info.limits.max_vertices, 10000)
        engines = {engine.name: engine for engine in info.engines}
        self.assertEqual(engines["nvcloth"].max_spheres, 32)
        self.assertEqual(engines["nvcloth"].profile, "tangent_hull")


class ErrorTest(ServerTest):
    """What the server refuses."""

    def test_a_number_out_of_range_names_field_value_and_limit(self):
        error = self.failing(self.body, max_primitives=3)
        self.assertEqual((error.code, error.reason), ("INVALID_ARGUMENT", "OUT_OF_RANGE"))
        self.assertEqual(error.field, "options.budget.max_primitives")
        self.assertEqual((error.value, error.limit), ("3", "[15, 1000]"))
        self.assertEqual(str(error), f"INVALID_ARGUMENT OUT_OF_RANGE: {error.message}")
        self.assertTrue(error.message.startswith("options.budget.max_primitives is 3"))

    def test_an_element_of_an_array_is_named_as_the_caller_counts(self):
        vertices = self.vertices.copy()
        vertices[7, 1] = numpy.nan
        error = self.failing(vertices=vertices.astype(numpy.float32), faces=self.faces)
        self.assertEqual(error.reason, "NOT_FINITE")
        self.assertEqual(error.field, "mesh.arrays.positions[22]")
        faces = numpy.array(self.faces)[:, :3]
        faces[5, 2] = len(vertices)
        error = self.failing(vertices=self.vertices, faces=faces)
        self.assertEqual(error.reason, "OUT_OF_RANGE")
        self.assertEqual(error.field, "mesh.arrays.triangle_indices[17]")

    def test_a_line_of_a_file_is_named(self):
        lines = self.body.read_text().splitlines()
        place = next(i for i, line in enumerate(lines) if line.startswith("v "))
        lines[place] = "v 0 zero 0"
        error = self.failing("\n".join(lines).encode(), file_format="obj")
        self.assertEqual((error.reason, error.field), ("MALFORMED_FILE", "mesh.file"))
        self.assertEqual(error.metadata["line"], str(place + 1))

    def test_what_is_no_body_comes_with_the_warnings(self):
        corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        cube = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        error = self.failing(vertices=corners + [(9, 9, 9)], faces=cube)
        self.assertEqual(error.code, "FAILED_PRECONDITION")
        self.assertIn(f"ERROR_REASON_{error.reason}", error_pb2.ErrorReason.keys())
        self.assertTrue(error.warnings)
        for warning in error.warnings:
            self.assertRegex(warning.code, "^[A-Z_]+$")
            self.assertTrue(warning.message)

    def test_an_unknown_engine(self):
        error = self.failing(self.body, engine="physics")
        self.assertEqual((error.reason, error.field), ("UNKNOWN_VALUE", "options.engine"))

    def test_nothing_to_fit(self):
        error = self.failing(b"")
        self.assertEqual((error.code, error.reason), ("INVALID_ARGUMENT", "MISSING"))

    def test_a_deadline(self):
        error = self.failing(self.body, timeout=0.002, max_primitives=900, quality="tight")
        self.assertEqual(error.code, "DEADLINE_EXCEEDED")

    def test_nobody_there(self):
        with capfit.Client("127.0.0.1:1") as client:
            with self.assertRaises(capfit.CapfitError) as caught:
                client.server_info()
        self.assertEqual((caught.exception.code, caught.exception.reason), ("UNAVAILABLE", None))
        self.assertRegex(caught.exception.message, "cannot reach 127.0.0.1:1 .*capfit-server")

    def test_errors_can_be_pickled(self):
        error = self.failing(self.body, max_primitives=3)
        copy = pickle.loads(pickle.dumps(error))
        self.assertEqual(vars(copy), vars(error))


class RefusedHereTest(ServerTest):
    """What cannot even be sent."""

    def refused(self, kind, pattern, *body, **options):
        with self.assertRaisesRegex(kind, pattern):
            self.client.approximate(*(body or [self.body]), **options)

    def test_an_unknown_keyword_names_the_nearest(self):
        for name, near in (("max_primitves", "max_primitives"), ("fit", "fit_mode"),
                           ("up", "up_axis"), ("polygon_error", "max_polygon_error"),
                           ("tolerance_mm", "tolerance_m"), ("part", "parts"),
                           ("vertex_gaps", "want_vertex_gaps")):
            self.refused(TypeError, f"no option '{name}'; did you mean '{near}'", **{name: 1})
        self.refused(TypeError, "no option 'xyzzy'$", xyzzy=1)

    def test_an_unknown_word_lists_the_known(self):
        self.refused(ValueError, "quality is 'tigth', must be one of paper, tight, balanced; "
                     "did you mean 'tight'", quality="tigth")
        self.refused(ValueError, "parts is 'leg', must be one of torso, arms, legs", parts=["leg"])
        self.refused(ValueError, "unit is 'yard', must be one of metre", unit="yard")
        self.refused(ValueError, "parts names no part", parts=[])

    def test_budgets_exclude_each_other(self):
        self.refused(ValueError, "max_primitives and max_spheres exclude", max_primitives=20,
                     max_spheres=20)
        self.refused(ValueError, "max_polygon_error and max_capsules exclude",
                     max_polygon_error=0.1, max_capsules=9)

    def test_numbers_that_are_none(self):
        self.refused(TypeError, "max_primitives is '64'", max_primitives="64")
        self.refused(ValueError, "seed is -1", seed=-1)
        self.refused(ValueError, "timeout is 0", timeout=0)

    def test_meshes_that_are_none(self):
        self.refused(TypeError, "a body, or vertices and faces", self.body, vertices=self.vertices)
        with self.assertRaisesRegex(TypeError, "a body, or vertices and faces"):
            self.client.approximate(vertices=self.vertices)
        with self.assertRaises(FileNotFoundError):
            self.client.approximate(self.scratch / "nowhere.obj")
        for error, pattern, vertices, faces in (
                (ValueError, r"vertices is of shape \(3,\)", [0, 1, 2], self.faces),
                (ValueError, r"faces is of shape \(3,\)", self.vertices, numpy.arange(3)),
                (ValueError, "faces holds -1", self.vertices, [[0, 1, -1]]),
                (TypeError, "faces holds float64", self.vertices, [[0, 1, 2.0]])):
            with self.assertRaisesRegex(error, pattern):
                self.client.approximate(vertices=vertices, faces=faces)

    def test_addresses(self):
        for address in ("127.0.0.1:65536", "127.0.0.1:0"):
            with self.assertRaisesRegex(ValueError, r"must be in \[1, 65535\]"):
                capfit.Client(address)
        for address in ("", "a:b", "http://127.0.0.1:50051"):
            with self.assertRaisesRegex(ValueError, "must be HOST or HOST:PORT"):
                capfit.Client(address)
        for address in ("localhost", "[::1]", "[::1]:50051", "unix:/tmp/capfit",
                        "dns:///localhost"):
            capfit.Client(address).close()
