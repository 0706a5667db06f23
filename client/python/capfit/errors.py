"""What the server says when a call fails."""
from __future__ import annotations

import functools
import pathlib
from dataclasses import dataclass
from typing import Any, Dict, Optional, Tuple

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

from capfit.v1 import result_pb2

_DETAILS_KEY = "grpc-status-details-bin"
_PUSHBACK_KEY = "grpc-retry-pushback-ms"


@dataclass(frozen=True)
class FitWarning:
    """Something the caller should know about the input or the result.

    `code` is a stable word, e.g. "HOLES_CLOSED"; `count` is 0 where counting makes no sense.
    """

    code: str
    message: str
    count: int = 0


class CapfitError(Exception):
    """A call failed.

    code            gRPC's word: "INVALID_ARGUMENT", "FAILED_PRECONDITION", "UNAVAILABLE", ...
    message         one sentence: what, where and the limit
    reason          a word of capfit.v1.ErrorReason, e.g. "OUT_OF_RANGE"; None: the server was not
                    reached, or did not say
    field           path as in the request, e.g. "options.budget.max_primitives"; None: no field
    value, limit    what the field is and what it may be, as text, where they apply
    metadata        all facts that came, the three above included; for files also `line`, or
                    `element` and `row`
    warnings        what had been noticed about the mesh by then
    retry_seconds   how long the server asks to wait before the next try, where it does
    """

    def __init__(
        self,
        code: str,
        message: str,
        reason: Optional[str] = None,
        metadata: Optional[Dict[str, str]] = None,
        warnings: Tuple[FitWarning, ...] = (),
        retry_seconds: Optional[float] = None,
    ) -> None:
        super().__init__(code, message, reason, metadata, warnings, retry_seconds)
        self.code = code
        self.message = message
        self.reason = reason
        self.metadata = dict(metadata or {})
        self.field = self.metadata.get("field")
        self.value = self.metadata.get("value")
        self.limit = self.metadata.get("limit")
        self.warnings = tuple(warnings)
        self.retry_seconds = retry_seconds

    def __str__(self) -> str:
        return f"{self.code}{f' {self.reason}' if self.reason else ''}: {self.message}"


def contract_broken(problem: str) -> CapfitError:
    """For an answer that is not what the contract says."""
    return CapfitError("INTERNAL", f"the server's answer breaks the contract: {problem}")


def error_of(error: Any, address: str, timeout: float) -> CapfitError:
    """The error of a grpc.RpcError, with the details that came along."""
    trailers = dict(error.trailing_metadata() or ())
    details = _details_of(trailers.get(_DETAILS_KEY, b""))
    info = details.get("google.rpc.ErrorInfo", [None])[0]
    code: str = error.code().name
    message = error.details() or ""
    if info is None and code == "UNAVAILABLE":
        message = f"cannot reach {address} ({message}); does a capfit-server listen there?"
    if info is None and code == "DEADLINE_EXCEEDED":
        message = f"no answer within timeout={timeout:g} seconds"
    return CapfitError(
        code,
        message,
        info.reason if info else None,
        dict(info.metadata) if info else None,
        tuple(FitWarning(w.code, w.message, w.count) for w in details.get("capfit.v1.Warning", [])),
        _retry_seconds(trailers.get(_PUSHBACK_KEY), details),
    )


def _retry_seconds(pushback: Optional[str], details: Dict[str, Any]) -> Optional[float]:
    if pushback is not None:
        return int(pushback) / 1000 if pushback.isdigit() else None
    for retry in details.get("google.rpc.RetryInfo", []):
        return float(retry.retry_delay.seconds + retry.retry_delay.nanos * 1e-9)
    return None


def _details_of(trailer: bytes) -> Dict[str, Any]:
    """The messages of a google.rpc.Status by their types' names; those not known are left out."""
    messages: Dict[str, Any] = {}
    try:
        status = _rpc_message("Status").FromString(trailer)
    except DecodeError:
        return messages  # a proxy's, say; the code and the message are there all the same
    for detail in status.details:
        name = detail.type_url.rpartition("/")[2]
        if name == "capfit.v1.Warning":
            kind: Any = result_pb2.Warning
        elif name in ("google.rpc.ErrorInfo", "google.rpc.RetryInfo"):
            kind = _rpc_message(name.rpartition(".")[2])
        else:
            continue
        messages.setdefault(name, []).append(kind.FromString(detail.value))
    return messages


@functools.lru_cache(maxsize=None)
def _rpc_pool() -> Any:
    """A pool of its own: another package may have put its google.rpc into the default one."""
    data = (pathlib.Path(__file__).parent / "error_details.binpb").read_bytes()
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(data).file:
        pool.AddSerializedFile(file.SerializeToString())
    return pool


@functools.lru_cache(maxsize=None)
def _rpc_message(name: str) -> Any:
    descriptor = _rpc_pool().FindMessageTypeByName(f"google.rpc.{name}")
    if hasattr(message_factory, "GetMessageClass"):
        return message_factory.GetMessageClass(descriptor)
    return message_factory.MessageFactory(_rpc_pool()).GetPrototype(descriptor)
