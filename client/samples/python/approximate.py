"""Fits a body on a capfit server: approximate.py HOST:PORT BODY (package client/python)."""
import sys
import capfit

address, body = sys.argv[1:]
with capfit.Client(address) as client:
    result = client.approximate(body, max_primitives=64)
for x, y, z, radius in result.spheres:
    print("sphere", x, y, z, radius)
for first, second in result.capsules:
    print("capsule", first, second)
