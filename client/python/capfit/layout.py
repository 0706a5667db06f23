"""The layout to keep as the wire's message."""
from __future__ import annotations

from typing import Any, Union

from capfit.result import Result
from capfit.v1 import result_pb2, service_pb2
from capfit.words import number_of


def layout_of(layout: Union[str, Result]) -> Any:
    """A v1.Layout: a standard one by its name, or that of a result."""
    if isinstance(layout, str):
        return service_pb2.Layout(name=layout)
    message = service_pb2.Layout()
    part_words = result_pb2.BodyPart.DESCRIPTOR
    for name, part, mirror, place in zip(layout.sphere_names, layout.sphere_parts,
                                         layout.sphere_mirrors, layout.sphere_places):
        sphere = message.set.spheres.add(name=name, part=number_of(part_words, "part", part))
        if mirror is not None:
            sphere.mirror = mirror
        if place is not None:
            members = dict(place)
            members["bone"] = number_of(result_pb2.Bone.DESCRIPTOR, "bone", members["bone"])
            sphere.place.CopyFrom(result_pb2.BodyPlace(**members))
    for first, second in layout.capsules.tolist():
        message.set.capsules.add(first_sphere=first, second_sphere=second)
    return message
