"""Retries, uploads and answers, against a stand-in for the server that follows a script."""
import time
import unittest

import grpc
import numpy

import capfit
from capfit import errors
from capfit.v1 import mesh_pb2, options_pb2, result_pb2, service_pb2
from support import FakeServer

TRIANGLE = {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}


def response(**part):
    return service_pb2.ApproximateBodyResponse(**part)


def sphere(x, **members):
    center = mesh_pb2.Vector3(x=x)
    return result_pb2.Sphere(center=center, radius=1, part="BODY_PART_TORSO", **members)


def primitives(*capsules, spheres=2):
    parts = [sphere(i, name=f"torso_{i}", mirror=i) for i in range(spheres)]
    pairs = [result_pb2.Capsule(first_sphere=a, second_sphere=b, part="BODY_PART_TORSO")
             for a, b in capsules]
    return response(primitives=result_pb2.PrimitiveSet(spheres=parts, capsules=pairs))


def summary(**options):
    frame = result_pb2.Similarity(rotation=[1, 0, 0, 0, 1, 0, 0, 0, 1], scale=1)
    return response(summary=result_pb2.Summary(
        version="9.9.9", body_from_caller=frame,
        options=result_pb2.EffectiveOptions(unit="LENGTH_UNIT_METRE", **options)))


def weights(first_sphere, sphere_count, first_vertex, values, spheres=2, vertices=3):
    dense = result_pb2.DenseWeights(first_vertex=first_vertex, weights=values,
                                    vertex_count=len(values) // sphere_count)
    return response(skinning=result_pb2.SkinningChunk(
        total_sphere_count=spheres, total_vertex_count=vertices, first_sphere=first_sphere,
        sphere_count=sphere_count, dense=dense))


def gaps(first_vertex, values, total=3):
    return response(vertex_gaps=result_pb2.VertexGapsChunk(
        total_vertex_count=total, first_vertex=first_vertex, gaps=values))


def answer_with(*responses):
    """A script that reads the upload and sends these."""

    def script(requests, _):
        list(requests)
        yield from responses

    return script


def approximate(script, **options):
    with FakeServer(script) as server, capfit.Client(server.address) as client:
        return client.approximate(**{**TRIANGLE, **options})


class RetryTest(unittest.TestCase):
    """Which failures are tried again, when and how often."""

    def calls_of(self, failures, code, trailers=(), timeout=20.0):
        """How many calls a server sees that fails so many times first; the error, if any; the time
        that it takes."""

        def script(requests, context):
            list(requests)
            if server.calls <= failures:
                context.set_trailing_metadata(trailers)
                context.abort(code, "not now")
            yield from (primitives((0, 1)), summary())

        start = time.monotonic()
        error = None
        with FakeServer(script) as server, capfit.Client(server.address) as client:
            try:
                client.approximate(**TRIANGLE, timeout=timeout)
            except capfit.CapfitError as caught:
                error = caught
        return server.calls, error, time.monotonic() - start

    def test_unavailable_is_tried_four_times(self):
        self.assertEqual(self.calls_of(3, grpc.StatusCode.UNAVAILABLE)[:2], (4, None))
        calls, error, _ = self.calls_of(4, grpc.StatusCode.UNAVAILABLE)
        self.assertEqual((calls, error.code), (4, "UNAVAILABLE"))

    def test_a_full_server_is_tried_again_when_it_says_when(self):
        full = grpc.StatusCode.RESOURCE_EXHAUSTED
        calls, error, _ = self.calls_of(1, full)
        self.assertEqual((calls, error.code), (1, "RESOURCE_EXHAUSTED"))
        pushback = (("grpc-retry-pushback-ms", "300"),)
        calls, error, seconds = self.calls_of(2, full, pushback)
        self.assertEqual((calls, error), (3, None))
        self.assertGreaterEqual(seconds, 0.6)
        self.assertEqual(self.calls_of(1, full, (("grpc-retry-pushback-ms", "-1"),))[0], 1)

    def test_retry_info_says_when_too(self):
        status = errors._rpc_message("Status")(code=8, message="not now")
        retry = errors._rpc_message("RetryInfo")()
        retry.retry_delay.nanos = 400_000_000
        detail = status.details.add()
        detail.type_url = "type.googleapis.com/google.rpc.RetryInfo"
        detail.value = retry.SerializeToString()
        trailers = (("grpc-status-details-bin", status.SerializeToString()),)
        full = grpc.StatusCode.RESOURCE_EXHAUSTED
        calls, error, seconds = self.calls_of(1, full, trailers)
        self.assertEqual((calls, error), (2, None))
        self.assertGreaterEqual(seconds, 0.4)
        _, error, _ = self.calls_of(9, full, trailers)
        self.assertAlmostEqual(error.retry_seconds, 0.4)

    def test_no_try_would_begin_after_the_deadline(self):
        pushback = (("grpc-retry-pushback-ms", "60000"),)
        calls, error, seconds = self.calls_of(1, grpc.StatusCode.UNAVAILABLE, pushback, timeout=5.0)
        self.assertEqual((calls, error.code, error.retry_seconds), (1, "UNAVAILABLE", 60.0))
        self.assertLess(seconds, 4.0)

    def test_what_is_wrong_is_not_tried_again(self):
        for code in (grpc.StatusCode.INVALID_ARGUMENT, grpc.StatusCode.INTERNAL):
            calls, error, _ = self.calls_of(1, code)
            self.assertEqual((calls, error.code, error.reason), (1, code.name, None))
            self.assertEqual(error.message, "not now")

    def test_details_that_are_no_message_do_not_hide_the_error(self):
        trailers = (("grpc-status-details-bin", b"\xff\xff\xff"),)
        _, error, _ = self.calls_of(1, grpc.StatusCode.INTERNAL, trailers)
        self.assertEqual((error.code, error.message), ("INTERNAL", "not now"))


class UploadTest(unittest.TestCase):
    """What is sent."""

    def requests_of(self, **options):
        seen = []

        def script(requests, _):
            seen.extend(requests)
            yield from (primitives(), summary())

        approximate(script, **options)
        return seen

    def test_big_arrays_go_in_pieces_of_256_kib(self):
        vertices = numpy.random.default_rng(1).random((40_000, 3))
        faces = numpy.arange(3 * 50_000).reshape(-1, 3)
        header, *chunks = self.requests_of(vertices=vertices, faces=faces)
        encoding = header.header.mesh.arrays
        self.assertEqual((encoding.vertex_count, encoding.face_count), (40_000, 50_000))
        self.assertGreater(len(chunks), 4)
        for chunk in chunks:
            self.assertLessEqual(chunk.ByteSize(), 256 * 1024 + 64)
        positions = [x for chunk in chunks for x in chunk.chunk.arrays.positions_double]
        numpy.testing.assert_array_equal(numpy.reshape(positions, (-1, 3)), vertices)
        corners = [x for chunk in chunks for x in chunk.chunk.arrays.triangle_indices]
        numpy.testing.assert_array_equal(numpy.reshape(corners, (-1, 3)), faces)

    def test_polygons_of_any_number_of_corners(self):
        vertices = numpy.zeros((6, 3), numpy.float32)
        _, *chunks = self.requests_of(vertices=vertices, faces=[[0, 1, 2, 3], (3, 4, 5)])
        arrays = mesh_pb2.MeshArrays()
        for chunk in chunks:
            arrays.MergeFrom(chunk.chunk.arrays)
        self.assertEqual(len(arrays.positions), 18)
        self.assertEqual(list(arrays.face_sizes), [4, 3])
        self.assertEqual(list(arrays.face_indices), [0, 1, 2, 3, 3, 4, 5])

    def test_a_default_call_asks_for_nothing_in_particular(self):
        options = self.requests_of()[0].header.options
        self.assertEqual(options, options_pb2.FitOptions(
            fit_mode="FIT_MODE_ENCLOSE", quality="QUALITY_PAPER", sex="SEX_AUTO",
            skinning="SKINNING_FORM_NONE"))


class AnswerTest(unittest.TestCase):
    """What may come back."""

    def test_blocks_of_weights_and_gaps_are_put_together(self):
        result = approximate(answer_with(
            primitives((0, 1)), weights(0, 1, 0, [1, 2]), weights(0, 1, 2, [3]),
            weights(1, 1, 0, [4, 5, 6]), gaps(0, [7, 8]), gaps(2, [9]), summary()))
        numpy.testing.assert_array_equal(result.weights, [[1, 2, 3], [4, 5, 6]])
        numpy.testing.assert_array_equal(result.vertex_gaps, [7, 8, 9])
        self.assertEqual((result.version, result.unit), ("9.9.9", "metre"))

    def test_whole_rows_come_together(self):
        result = approximate(answer_with(
            primitives((0, 1)), weights(0, 2, 0, [1, 2, 3, 4, 5, 6]), summary()))
        numpy.testing.assert_array_equal(result.weights, [[1, 2, 3], [4, 5, 6]])

    def test_words_of_a_later_version_come_as_numbers(self):
        known = primitives((0, 1))
        known.primitives.spheres[0].part = 77
        result = approximate(answer_with(known, summary()))
        self.assertEqual(result.sphere_parts, ["77", "torso"])

    def test_an_answer_that_breaks_the_contract_is_an_internal_error(self):
        whole = primitives((0, 1))
        for problem, responses in {
                "ends without a summary": [whole],
                "primitives after primitives": [whole, whole, summary()],
                "progress after primitives": [whole, response(progress={}), summary()],
                "warning after summary": [whole, summary(), response(warning={})],
                "ends without 'spheres'": [summary()],
                "a capsule between spheres 0 and 2 of 2": [primitives((0, 2)), summary()],
                "a capsule between spheres 1 and 1 of 2": [primitives((1, 1)), summary()],
                "3 weights of 6": [whole, weights(0, 1, 0, [1, 2, 3]), summary()],
                "3 weights for spheres": [whole, weights(1, 1, 0, [1, 2, 3]), summary()],
                "4 weights for spheres": [whole, weights(0, 1, 0, [1, 2, 3, 4]), summary()],
                "2 vertex gaps of 3": [whole, gaps(0, [1, 2]), summary()],
                "gaps of vertices 1 to 3 of 3": [whole, gaps(1, [1, 2]), summary()],
                "gaps of vertices 0 to 4 of 3": [whole, gaps(0, [1, 2, 3, 4]), summary()],
        }.items():
            with self.subTest(problem), self.assertRaises(capfit.CapfitError) as caught:
                approximate(answer_with(*responses))
            self.assertEqual(caught.exception.code, "INTERNAL")
            self.assertIn(problem, caught.exception.message)
