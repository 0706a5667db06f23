"""Calls a capfit server."""
from __future__ import annotations

import functools
import inspect
import time
from typing import Any, Callable, Iterable, Optional, TypeVar, Union, cast

import grpc
from numpy.typing import ArrayLike

from capfit.answer import Answer, ProgressFunction
from capfit.connection import DEFAULT_PORT, open_channel, token_metadata, with_port
from capfit.errors import CapfitError, error_of
from capfit.layout import layout_of
from capfit.options import Landmarks, Words, fit_options
from capfit.result import Result
from capfit.server_info import ServerInfo, info_of
from capfit.upload import Body, Faces, array_upload, file_upload
from capfit.v1 import mesh_pb2, server_info_pb2, service_pb2, service_pb2_grpc
from capfit.words import nearest, number_of

_MAX_ATTEMPTS = 4
_FIRST_PAUSE_SECONDS = 0.2

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Value = TypeVar("_Value")


def _naming_nearest(function: _Function) -> _Function:
    """A keyword that the function does not have is a TypeError that names the nearest it has."""
    known = set(inspect.signature(function).parameters) - {"self"}

    @functools.wraps(function)
    def checked(*arguments: Any, **keywords: Any) -> Any:
        for name in keywords:
            if name not in known:
                raise TypeError(f"{function.__name__}() has no option {name!r}"
                                + nearest(name, known))
        return function(*arguments, **keywords)

    return cast(_Function, checked)


class Client:
    """A connection to a capfit server: `Client("HOST:PORT")`, or "HOST" for port 50051.

    Connects at the first call, may be used from several threads at once, and is a context manager:

        with capfit.Client("127.0.0.1:50051") as client:
            result = client.approximate("body.glb", max_primitives=64, parts="all")

    Several servers share the calls: "HOST:PORT,HOST:PORT", or all addresses of a name of DNS:
    "dns:///HOST:PORT".

    tls                 speak TLS, trusting whom the machine trusts
    root_certificates   speak TLS, trusting only who signed here (PEM, as bytes)
    certificate, key    your own, for servers that ask for one (PEM, as bytes)
    server_name         in the server's certificate, where it is not the host of the address
    token               what the operator gave you, for servers that ask for one
    """

    def __init__(
        self,
        address: str,
        *,
        tls: bool = False,
        root_certificates: Optional[bytes] = None,
        certificate: Optional[bytes] = None,
        key: Optional[bytes] = None,
        server_name: Optional[str] = None,
        token: Optional[str] = None,
    ) -> None:
        self._address = address if "," in address else with_port(address)
        self._channel = open_channel(
            address, tls=tls, root_certificates=root_certificates, certificate=certificate,
            key=key, server_name=server_name)
        self._metadata = token_metadata(token)
        make_stub: Any = service_pb2_grpc.BodyApproximationServiceStub
        self._stub = make_stub(self._channel)

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection, and the calls that are under way."""
        self._channel.close()

    @_naming_nearest
    def approximate(
        self,
        body: Optional[Body] = None,
        *,
        vertices: Optional[ArrayLike] = None,
        faces: Optional[Faces] = None,
        file_format: str = "auto",
        unit: str = "auto",
        up_axis: str = "auto",
        max_primitives: Optional[int] = None,
        max_spheres: Optional[int] = None,
        max_capsules: Optional[int] = None,
        max_polygon_error: Optional[float] = None,
        engine: str = "",
        parts: Optional[Words] = None,
        require_parts: Optional[Words] = None,
        fit_mode: str = "enclose",
        quality: str = "paper",
        tolerance_m: float = 0.0,
        sex: str = "auto",
        skinning: str = "none",
        landmarks: Optional[Landmarks] = None,
        seed: int = 0,
        want_feature_polygons: bool = False,
        want_vertex_gaps: bool = False,
        include_parts: Iterable[str] = (),
        exclude_parts: Iterable[str] = (),
        include_hair: bool = False,
        include_skirt: bool = False,
        layout: Union[str, Result, None] = None,
        exports: Words = (),
        request_id: str = "",
        timeout: float = 300.0,
        on_progress: Optional[ProgressFunction] = None,
    ) -> Result:
        """Fits spheres and capsules to a body.

        The mesh is a file (`body`: its path or its bytes; `file_format` obj, ply, stl, off, glb) or
        arrays: `vertices` (n, 3) and `faces` (m, 3), or a list of polygons of vertex indices.

        unit, up_axis       m, cm, mm, in; x, y, z; "auto": found from the body
        max_primitives      spheres and cones together; default: 64
        max_spheres, max_capsules    counted apart, instead; one or both
        max_polygon_error   as many as bring each section's error down to this, instead
        engine              a cloth engine whose limits and capsules hold, e.g. "nvcloth"
        parts               "all", or words of torso, arms, legs, head, hands, feet, as a list or
                            with commas; default: torso, arms, legs
        require_parts       refuse a body without these
        fit_mode            "enclose": nothing outside; "best": the smallest error
        quality             "paper": the published method; "tight": closer, in more time; "balanced":
                            almost as close, in about the time of "paper"
        tolerance_m         how far a vertex may stick out with "enclose", in metres
        sex                 "auto", "female", "male": whether the bust may be split
        skinning            what carries the centres along: "sparse" (some 100 vertices each),
                            "bones" (joints of the mesh's file), "dense" (all vertices)
        landmarks           {name: (x, y, z)} that you know better
        seed                the same seed gives the same bits
        want_feature_polygons, want_vertex_gaps    whether they come too
        include_parts, exclude_parts    names of meshes or materials of the file that are the
                            body's, or not; "*" and "?" stand for other characters
        include_hair, include_skirt    whether they are enclosed too
        layout              in place of a budget: the name of a standard layout ("standard-32"), or
                            a former Result, whose spheres, names and capsules are kept
        exports             formats of files for engines ("gltf", "unity", ...), which come as
                            Result.exports; server_info().export_formats lists them
        request_id          name of the job in the server's logs
        timeout             seconds for the whole call, upload and queueing included
        on_progress         called with the stage's name and the fraction done, on this thread

        A server that is full or not reachable is asked up to four times, with the pauses that it
        names. CapfitError: the call failed. ValueError, TypeError: what was given cannot even be
        sent. OSError: the file cannot be read.
        """
        if (body is None) == (vertices is None) or (vertices is None) != (faces is None):
            raise TypeError("approximate() takes a body, or vertices and faces")
        if body is not None:
            mesh, upload = file_upload(body, file_format)
        else:
            mesh, upload = array_upload(cast(Any, vertices), cast(Any, faces))
        mesh.unit = number_of(mesh_pb2.LengthUnit.DESCRIPTOR, "unit", unit)
        mesh.up_axis = number_of(mesh_pb2.UpAxis.DESCRIPTOR, "up_axis", up_axis)
        options = fit_options(
            max_primitives=max_primitives, max_spheres=max_spheres, max_capsules=max_capsules,
            max_polygon_error=max_polygon_error, engine=engine, parts=parts,
            require_parts=require_parts, fit_mode=fit_mode, quality=quality,
            tolerance_m=tolerance_m, sex=sex, skinning=skinning, landmarks=landmarks, seed=seed,
            want_feature_polygons=want_feature_polygons, want_vertex_gaps=want_vertex_gaps,
            include_parts=include_parts, exclude_parts=exclude_parts, include_hair=include_hair,
            include_skirt=include_skirt)
        header = service_pb2.ApproximateBodyHeader(mesh=mesh, options=options,
                                                   request_id=request_id)
        if layout is not None:
            header.layout.CopyFrom(layout_of(layout))
        for name in exports.replace(",", " ").split() if isinstance(exports, str) else exports:
            header.exports.add(format=name)
        first = service_pb2.ApproximateBodyRequest(header=header)

        def attempt(seconds: float) -> Result:
            call = self._stub.ApproximateBody(upload(first), timeout=seconds,
                                              metadata=self._metadata)
            answer = Answer(on_progress)
            try:
                for response in call:
                    answer.add(response)
                return answer.result()
            finally:
                call.cancel()  # does nothing where the call has ended

        return self._with_retries(timeout, attempt)

    def server_info(self, timeout: float = 10.0) -> ServerInfo:
        """What the server is and what it accepts. CapfitError: the call failed."""
        request = server_info_pb2.GetServerInfoRequest()

        def attempt(seconds: float) -> ServerInfo:
            return info_of(self._stub.GetServerInfo(request, timeout=seconds,
                                                    metadata=self._metadata))

        return self._with_retries(timeout, attempt)

    def _with_retries(self, timeout: float, attempt: Callable[[float], _Value]) -> _Value:
        """Tries until one succeeds, or another is of no use or would end after the deadline."""
        if not timeout > 0:
            raise ValueError(f"timeout is {timeout!r}, must be above 0 seconds")
        deadline = time.monotonic() + timeout
        number = 1
        while True:
            try:
                return attempt(max(deadline - time.monotonic(), 0.001))
            except grpc.RpcError as rpc_error:
                error = error_of(rpc_error, self._address, timeout)
                pause = _pause_after(error, number)
                if pause is None or time.monotonic() + pause >= deadline:
                    raise error from rpc_error
            time.sleep(pause)
            number += 1


def _pause_after(error: CapfitError, attempt: int) -> Optional[float]:
    """What the server asked for, else twice as long each time; None: no use in another try."""
    if error.code not in ("UNAVAILABLE", "RESOURCE_EXHAUSTED") or attempt == _MAX_ATTEMPTS:
        return None
    if error.retry_seconds is not None:
        return error.retry_seconds
    if error.code == "RESOURCE_EXHAUSTED":
        return None
    return float(_FIRST_PAUSE_SECONDS * 2 ** (attempt - 1))
