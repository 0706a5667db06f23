"""Fits a body on a capfit server: approximate.py HOST:PORT BODY.obj (see run.sh for the generated modules)."""
import sys, grpc
from capfit.v1 import mesh_pb2, service_pb2, service_pb2_grpc

def messages(path):
    mesh = mesh_pb2.MeshHeader(file=mesh_pb2.FileEncoding())
    yield service_pb2.ApproximateBodyRequest(header=service_pb2.ApproximateBodyHeader(mesh=mesh))
    with open(path, "rb") as file:
        while piece := file.read(262144):
            yield service_pb2.ApproximateBodyRequest(chunk=mesh_pb2.MeshChunk(file_bytes=piece))

server, path = sys.argv[1:]
stub = service_pb2_grpc.BodyApproximationServiceStub(grpc.insecure_channel(server))
for response in stub.ApproximateBody(messages(path), timeout=300):
    if response.HasField("primitives"):
        for s in response.primitives.spheres:
            print("sphere", s.center.x, s.center.y, s.center.z, s.radius)
        for c in response.primitives.capsules:
            print("capsule", c.first_sphere, c.second_sphere)
