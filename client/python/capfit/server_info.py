"""What a server is and what it accepts."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, List, Optional

from capfit.words import message_document


@dataclass(frozen=True)
class ServerLimits:
    """What is beyond is refused; meanings: v1.ServerLimits."""

    max_upload_bytes: int
    max_vertices: int
    max_faces: int
    max_corners_per_face: int
    max_message_bytes: int
    max_concurrent_fits: int
    max_queued_fits: int
    threads: int


@dataclass(frozen=True)
class Engine:
    """A cloth engine; a limit of 0 is none. `profile`: "tangent_hull", "lerped_radius" or
    "uniform_radius"."""

    name: str
    max_spheres: int
    max_capsules: int
    max_shapes: int
    profile: Optional[str]


@dataclass(frozen=True)
class StandardLayout:
    """A layout that `Client.approximate(layout=name)` keeps."""

    name: str
    sphere_count: int
    capsule_count: int


@dataclass(frozen=True)
class ExportFormat:
    """Files for an engine. `needs_original`: the body must come as a file of that format."""

    name: str
    summary: str
    needs_original: bool


@dataclass(frozen=True)
class ServerInfo:
    """`formats`: "obj", ...; `features`: the words that v1.GetServerInfoResponse explains."""

    version: str
    limits: ServerLimits
    formats: List[str]
    engines: List[Engine]
    features: List[str]
    layouts: List[StandardLayout]
    export_formats: List[ExportFormat]


def info_of(response: Any) -> ServerInfo:
    """Of a v1.GetServerInfoResponse."""
    members = message_document(response)
    members["limits"] = ServerLimits(**members["limits"])
    members["engines"] = [Engine(**engine) for engine in members["engines"]]
    members["layouts"] = [StandardLayout(**layout) for layout in members["layouts"]]
    members["export_formats"] = [ExportFormat(**one) for one in members["export_formats"]]
    return ServerInfo(**members)
