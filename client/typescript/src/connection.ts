// The way to one server or several.
import {
  type ChannelCredentials, type ChannelOptions, Metadata, credentials,
} from "@grpc/grpc-js";
import { isIP } from "node:net";

import { stringOf } from "./checks";
import { invalidField } from "./errors";

const DEFAULT_PORT = 50051;

/** How the two sides know each other; PEM texts, not paths. */
export interface Security {
  /** Speak TLS, trusting whom Node.js trusts. */
  tls?: boolean;
  /** Speak TLS, trusting only who signed here. */
  rootCertificates?: string | Buffer;
  /** Your own certificate and its key, for servers that ask for one. */
  certificate?: string | Buffer;
  key?: string | Buffer;
  /** The name in the server's certificate, where it is not the host of the address. */
  serverName?: string;
  /** What the operator gave you, for servers that ask for one. */
  token?: string;
}

export const SECURITY_NAMES = [
  "tls", "rootCertificates", "certificate", "key", "serverName", "token",
] as const;

export function credentialsOf(security: Security): ChannelCredentials {
  const { tls, rootCertificates, certificate, key } = security;
  if (!tls && rootCertificates === undefined && certificate === undefined) {
    return credentials.createInsecure();
  }
  return credentials.createSsl(bytesOf(rootCertificates), bytesOf(key), bytesOf(certificate));
}

// As metadata and not as call credentials, which need TLS: a token also serves in front of a proxy
// on this machine that speaks TLS.
export function metadataOf(security: Security): Metadata {
  const metadata = new Metadata();
  if (security.token !== undefined) {
    metadata.set("authorization", `Bearer ${stringOf(security.token, "client.token")}`);
  }
  return metadata;
}

// gRPC's own attempts are off: they are counted in retries.ts. Calls go round all addresses.
export function channelOptions(security: Security): ChannelOptions {
  const options: ChannelOptions = {
    "grpc.enable_retries": 0,
    "grpc.service_config": JSON.stringify({ loadBalancingConfig: [{ round_robin: {} }] }),
  };
  if (security.serverName !== undefined) {
    options["grpc.ssl_target_name_override"] = security.serverName;
    options["grpc.default_authority"] = security.serverName;
  }
  return options;
}

// grpc-js takes several addresses in one target only as numbers.
export function targetOf(addresses: string): string {
  const pieces = addresses.split(",");
  if (pieces.length === 1) return addresses;
  const kinds = new Set(pieces.map((piece) => isIP(hostOf(piece))));
  if (kinds.size === 1 && kinds.has(4)) return `ipv4:${addresses}`;
  if (kinds.size === 1 && kinds.has(6)) return `ipv6:${addresses}`;
  const problem = "must be one address, or numeric ones of one kind, or dns:///HOST:PORT";
  throw invalidField("OUT_OF_RANGE", "address", problem, addresses);
}

// grpc-js would take port 443.
export function withPort(address: string): string {
  return /^(\[[^\]]*\]|[^:/]+)$/.test(address) ? `${address}:${DEFAULT_PORT}` : address;
}

function hostOf(address: string): string {
  return address.slice(0, address.lastIndexOf(":")).replace(/^\[|\]$/g, "");
}

function bytesOf(text: string | Buffer | undefined): Buffer | null {
  return text === undefined ? null : Buffer.from(text);
}
