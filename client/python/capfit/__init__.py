"""Human bodies as few spheres and tapered capsules, by a capfit server.

    import capfit

    with capfit.Client("127.0.0.1:50051") as client:
        result = client.approximate("body.glb", max_primitives=64, parts="all", quality="tight")
    print(result.spheres)   # float64 (k, 4): x, y, z, r in the mesh's unit and axes
    print(result.capsules)  # int32 (c, 2): pairs of spheres
"""
from capfit.answer import ProgressFunction
from capfit.client import Client
from capfit.connection import DEFAULT_PORT
from capfit.errors import CapfitError, FitWarning
from capfit.result import (BodyFacts, FeaturePolygon, GapStatistics, Landmark, MeshPart, Metrics,
                           PartMetrics, Result, Similarity)
from capfit.server_info import Engine, ServerInfo, ServerLimits

__all__ = [
    "BodyFacts", "CapfitError", "Client", "DEFAULT_PORT", "Engine", "FeaturePolygon", "FitWarning",
    "GapStatistics", "Landmark", "MeshPart", "Metrics", "PartMetrics", "ProgressFunction", "Result",
    "ServerInfo", "ServerLimits", "Similarity",
]
