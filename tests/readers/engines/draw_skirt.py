"""Draws frames that check_skirt.mjs wrote: draw_skirt.py FRAMES.json PICTURE.png."""
import json
import sys

import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
import numpy  # noqa: E402

LIGHT = numpy.array([0.4, 0.6, 0.7]) / numpy.linalg.norm([0.4, 0.6, 0.7])
TURN = numpy.radians(35.0)
VIEW = numpy.array([[numpy.cos(TURN), 0, -numpy.sin(TURN)], [0, 1, 0],
                    [numpy.sin(TURN), 0, numpy.cos(TURN)]])


def solid_triangles(ends, rings=16, segments=24):
    """Around the axis of one sphere or two."""
    first, last = ends[0], ends[-1]
    a, b = numpy.array(first["center"]), numpy.array(last["center"])
    length = numpy.linalg.norm(b - a)
    axis = (b - a) / length if length > 0 else numpy.array([0.0, 1.0, 0.0])
    side = numpy.cross(axis, [1.0, 0, 0] if abs(axis[0]) < 0.9 else [0, 1.0, 0])
    side /= numpy.linalg.norm(side)
    other = numpy.cross(axis, side)
    slant = numpy.arcsin((first["radius"] - last["radius"]) / length) if length > 0 else 0.0
    outline = [(a, first["radius"], t) for t in numpy.linspace(-numpy.pi / 2, slant, rings)]
    # Short faces along the cone: what is drawn last is what is nearer in the middle.
    outline += [(a + t * (b - a), first["radius"] + t * (last["radius"] - first["radius"]), slant)
                for t in numpy.linspace(0, 1, 1 + int(length / 0.01))[1:-1]]
    outline += [(b, last["radius"], t) for t in numpy.linspace(slant, numpy.pi / 2, rings)]
    around = numpy.linspace(0, 2 * numpy.pi, segments + 1)
    out = numpy.cos(around)[:, None] * side + numpy.sin(around)[:, None] * other
    grid = numpy.array([c + r * (numpy.sin(t) * axis + numpy.cos(t) * out) for c, r, t in outline])
    p, q, r, s = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    return numpy.concatenate([numpy.stack([p, q, r], 2).reshape(-1, 3, 3),
                              numpy.stack([p, r, s], 2).reshape(-1, 3, 3)])


def draw(axes, frame, faces):
    body = numpy.concatenate([solid_triangles(ends) for ends in frame["ends"]])
    skirt = numpy.array(frame["points"])[faces]
    triangles = numpy.concatenate([body, skirt]) @ VIEW.T
    colours = numpy.concatenate([numpy.tile([0.86, 0.72, 0.62], (len(body), 1)),
                                 numpy.tile([0.25, 0.42, 0.72], (len(skirt), 1))])
    normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= numpy.linalg.norm(normals, axis=1, keepdims=True) + 1e-12
    shade = 0.35 + 0.65 * numpy.abs(normals @ LIGHT)
    depth = triangles[:, :, 2].mean(1)
    depth[len(body):] += 0.01
    order = numpy.argsort(depth)
    shaded = (colours * shade[:, None])[order]
    axes.add_collection(PolyCollection(triangles[order][:, :, :2], facecolors=shaded,
                                       edgecolors=shaded, linewidths=0.3))
    axes.set_xlim(-0.62, 0.55)
    axes.set_ylim(-0.02, 1.7)
    axes.set_aspect("equal")
    axes.axis("off")


with open(sys.argv[1], encoding="ascii") as file:
    data = json.load(file)
figure, panels = pyplot.subplots(1, len(data["frames"]), figsize=(9, 5), dpi=80)
for axes, frame in zip(panels, data["frames"]):
    draw(axes, frame, numpy.array(data["faces"]))
figure.subplots_adjust(0, 0, 1, 1, 0, 0)
figure.savefig(sys.argv[2])
