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
class ServerInfo:
    """`formats`: "obj", ...; `features`: the words that v1.GetServerInfoResponse explains."""

    version: str
    limits: ServerLimits
    formats: List[str]
    engines: List[Engine]
    features: List[str]


def info_of(response: Any) -> ServerInfo:
    """Of a v1.GetServerInfoResponse."""
    members = message_document(response)
    members["limits"] = ServerLimits(**members["limits"])
    members["engines"] = [Engine(**engine) for engine in members["engines"]]
    return ServerInfo(**members)
