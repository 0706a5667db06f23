"""The way to one server or several."""
from __future__ import annotations

import re
import socket
from typing import List, Optional, Sequence, Tuple

import grpc

DEFAULT_PORT = 50051
_HEALTH = '"healthCheckConfig": {"serviceName": "capfit.v1.BodyApproximationService"}'


def open_channel(
    addresses: str,
    *,
    tls: bool,
    root_certificates: Optional[bytes],
    certificate: Optional[bytes],
    key: Optional[bytes],
    server_name: Optional[str],
) -> grpc.Channel:
    """Connects with the first call. Calls go round all servers of a list or a name of DNS.

    ValueError: an address is wrong. OSError: a host of a list is not known.
    """
    target = target_of(addresses)
    # gRPC's own retries stall when a call that is still sending its upload is repeated.
    options: List[Tuple[str, object]] = [("grpc.enable_retries", 0),
                                         ("grpc.service_config", service_config(target))]
    if server_name is None and "," in target:
        server_name = _host_and_port(addresses.split(",")[0])[0]
    if server_name:
        options.append(("grpc.ssl_target_name_override", server_name))
    if not tls and root_certificates is None and certificate is None:
        return grpc.insecure_channel(target, options=options)
    credentials = grpc.ssl_channel_credentials(root_certificates, key, certificate)
    return grpc.secure_channel(target, credentials, options=options)


def target_of(addresses: str) -> str:
    """HOST:PORT of HOST or HOST:PORT; several with commas between become numbers, as gRPC takes
    them; gRPC's own targets (unix:..., dns:///...) stay as they are."""
    pieces = [with_port(address) for address in addresses.split(",")]
    if len(pieces) == 1:
        return pieces[0]
    for family, scheme in ((socket.AF_INET, "ipv4"), (socket.AF_INET6, "ipv6")):
        try:
            return scheme + ":" + ",".join(_number_of(piece, family) for piece in pieces)
        except socket.gaierror as error:
            problem = error
    raise OSError(f"no common kind of address is known for the hosts of {addresses!r}: {problem}")


def service_config(target: str) -> str:
    """Several servers are asked for their health; one is not, since it may be a proxy."""
    health = ", " + _HEALTH if "," in target or "://" in target else ""
    return '{"loadBalancingConfig": [{"round_robin": {}}]' + health + "}"


def with_port(address: str) -> str:
    """HOST:PORT of HOST, [V6] or HOST:PORT; gRPC's own targets (unix:..., dns:///...) as is."""
    if re.match(r"(unix|unix-abstract|vsock|ipv4|ipv6):|[a-z]+:///", address):
        return address
    host, port = _host_and_port(address)
    if not 1 <= port <= 65535:
        raise ValueError(f"the port of {address!r} must be in [1, 65535]")
    return f"{host}:{port}"


def token_metadata(token: Optional[str]) -> Sequence[Tuple[str, str]]:
    """What is sent with each call."""
    return () if not token else (("authorization", f"Bearer {token}"),)


def _host_and_port(address: str) -> Tuple[str, int]:
    match = re.fullmatch(r"(\[[0-9a-fA-F:.%]+\]|[^:\[\]/]+)(?::([0-9]+))?", address)
    if match is None:
        raise ValueError(f"address is {address!r}, must be HOST or HOST:PORT")
    return match[1], DEFAULT_PORT if match[2] is None else int(match[2])


def _number_of(address: str, family: socket.AddressFamily) -> str:
    host, port = _host_and_port(address)
    number = socket.getaddrinfo(host.strip("[]"), None, family)[0][4][0]
    return f"[{number}]:{port}" if family == socket.AF_INET6 else f"{number}:{port}"
