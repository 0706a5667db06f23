"""Callers who hold a server's memory and give nothing: uploads that stop, answers that nobody reads.

    crowd.py ADDRESS PROTO_FOLDER BODY.ply UPLOADS READERS [TOKEN]

Opens UPLOADS calls that send their header and then nothing, and READERS calls that ask for a large
answer and never read it, and opens each again when the server ends it, until standard input closes.
Prints one line of JSON at the end: how many calls of either kind ended, by status.
"""
import asyncio
import collections
import importlib
import json
import os
import subprocess
import sys
import tempfile

import grpc

# A connection for each channel, and none that takes more than 64 KiB before somebody reads.
ALONE = [("grpc.use_local_subchannel_pool", 1), ("grpc.http2.bdp_probe", 0)]
HOLD_SECONDS = 75.0  # longer than a server waits for anybody
SETTLE_SECONDS = 1.0  # between two calls of one caller, so that a full server is not asked in a circle


def generate(proto_folder):
    """The wire's modules, made by protoc into a folder of their own."""
    folder = tempfile.mkdtemp(prefix="capfit_crowd_")
    files = [f"capfit/v1/{name}.proto" for name in ("mesh", "options", "result", "server_info", "service")]
    subprocess.run(["protoc", f"--proto_path={proto_folder}", f"--python_out={folder}",
                    f"--grpc_python_out={folder}", "--plugin=protoc-gen-grpc_python=/usr/bin/grpc_python_plugin",
                    *files], check=True)
    sys.path.insert(0, folder)
    return importlib.import_module("capfit.v1.service_pb2"), importlib.import_module("capfit.v1.service_pb2_grpc")


def options_pb2():
    return importlib.import_module("capfit.v1.options_pb2")


def dense_request(wire, body):
    """Header and chunks of a body whose answer, with dense weights, is larger than any buffer of gRPC's."""
    header = wire.ApproximateBodyRequest()
    header.header.mesh.file.byte_count = len(body)
    header.header.options.skinning = options_pb2().SKINNING_FORM_DENSE
    step = 256 * 1024
    chunks = []
    for begin in range(0, len(body), step):
        chunk = wire.ApproximateBodyRequest()
        chunk.chunk.file_bytes = body[begin:begin + step]
        chunks.append(chunk)
    return [header, *chunks]


class Crowd:
    def __init__(self, address, wire, stubs, token):
        self.address, self.wire, self.stubs = address, wire, stubs
        self.metadata = [("authorization", "Bearer " + token)] if token else []
        self.ends = {"uploads": collections.Counter(), "readers": collections.Counter()}

    async def repeat(self, kind, messages, closes):
        while True:
            async with grpc.aio.insecure_channel(self.address, options=ALONE) as channel:
                call = self.stubs.BodyApproximationServiceStub(channel).ApproximateBody(metadata=self.metadata)
                try:
                    for message in messages:
                        await call.write(message)
                    if closes:
                        await call.done_writing()
                except (grpc.aio.AioRpcError, asyncio.InvalidStateError):
                    pass
                # Not a read: what came stays where it is. Who does not read is not told that it was cut off.
                done, _ = await asyncio.wait([asyncio.ensure_future(call.code())], timeout=HOLD_SECONDS)
                self.ends[kind][done.pop().result().name if done else "HELD"] += 1
            await asyncio.sleep(SETTLE_SECONDS)


async def main():
    address, proto_folder, body_path, uploads, readers = sys.argv[1:6]
    wire, stubs = generate(proto_folder)
    with open(body_path, "rb") as file:
        request = dense_request(wire, file.read())
    crowd = Crowd(address, wire, stubs, sys.argv[6] if len(sys.argv) > 6 else "")
    tasks = [asyncio.create_task(crowd.repeat("uploads", request[:1], False)) for _ in range(int(uploads))]
    tasks += [asyncio.create_task(crowd.repeat("readers", request, True)) for _ in range(int(readers))]
    await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
    print(json.dumps({kind: dict(ends) for kind, ends in crowd.ends.items()}), flush=True)
    os._exit(0)  # hundreds of open calls: gRPC's own way out may take for ever


asyncio.run(main())
