"""A real server, a body and an in-process stand-in for the server."""
from __future__ import annotations

import concurrent.futures
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

import grpc
import numpy

import capfit
from capfit.v1 import service_pb2_grpc

ROOT = pathlib.Path(__file__).resolve().parents[3]


def run_capfit(*arguments):
    """Runs the command line to its end."""
    subprocess.run([os.environ["CAPFIT_PROGRAM"], *map(str, arguments)], check=True,
                   stdout=subprocess.DEVNULL)


def read_obj(path):
    """Vertices (n, 3) and faces of an OBJ file, as lists of vertex indices."""
    vertices, faces = [], []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        if words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return numpy.array(vertices), faces


class ServerTest(unittest.TestCase):
    """A real server for all tests of a class, a mannequin and a client."""

    @classmethod
    def setUpClass(cls):
        assert capfit.__file__.startswith(os.environ["CAPFIT_SITE"]), capfit.__file__
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = pathlib.Path(scratch.name)
        cls.body = cls.scratch / "body.obj"
        run_capfit("mannequin", "-o", cls.body, "--faces", 6000)
        cls.vertices, cls.faces = read_obj(cls.body)
        cls.address = cls._start_server()
        cls.client = capfit.Client(cls.address)
        cls.addClassCleanup(cls.client.close)

    @classmethod
    def _start_server(cls):
        port_file = cls.scratch / "port"
        server = subprocess.Popen(
            [os.environ["CAPFIT_SERVER_PROGRAM"], "--listen", "127.0.0.1:0", "--port-file",
             str(port_file)], stderr=subprocess.DEVNULL)
        cls.addClassCleanup(server.wait)
        cls.addClassCleanup(server.kill)
        for _ in range(300):
            if port_file.exists() and port_file.read_text().strip():
                return f"127.0.0.1:{port_file.read_text().strip()}"
            time.sleep(0.1)
        raise RuntimeError("the server did not start")

    def failing(self, *body, **options):
        """The CapfitError of a call that must fail."""
        with self.assertRaises(capfit.CapfitError) as caught:
            self.client.approximate(*body, **options)
        return caught.exception


class FakeServer(service_pb2_grpc.BodyApproximationServiceServicer):
    """Answers each call by `script(request_iterator, context)`, a generator of responses."""

    def __init__(self, script):
        self.script = script
        self.calls = 0
        self._server = grpc.server(concurrent.futures.ThreadPoolExecutor(2))
        service_pb2_grpc.add_BodyApproximationServiceServicer_to_server(self, self._server)
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"

    def ApproximateBody(self, request_iterator, context):
        self.calls += 1
        yield from self.script(request_iterator, context)

    def __enter__(self):
        self._server.start()
        return self

    def __exit__(self, *_):
        self._server.stop(None).wait()
