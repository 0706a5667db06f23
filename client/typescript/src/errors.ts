// The one error of this package, and how it is read from a call's status.
import { type Metadata, type ServiceError, status as StatusNumber } from "@grpc/grpc-js";

import { DetailMessages, RichStatus } from "./contract";
import type { ErrorReason as ErrorReasonName } from "./generated/capfit/v1/ErrorReason";
import type { RetryInfo__Output } from "./generated/google/rpc/RetryInfo";

/** A canonical code of gRPC, e.g. "INVALID_ARGUMENT". */
export type StatusCode = Exclude<keyof typeof StatusNumber, "OK">;

type Stripped<Name> = Name extends `ERROR_REASON_${infer Rest}`
  ? Exclude<Rest, "UNSPECIFIED">
  : never;
/** Why a call failed, as docs/errors.md lists it. Later servers may have further reasons. */
export type ErrorReason = Stripped<ErrorReasonName> | (string & {});

/** Something noticed about the request, the mesh or the result. */
export interface Warning {
  /** A stable word, e.g. "HOLES_CLOSED". */
  code: string;
  /** One sentence: what, where, how many. */
  message: string;
  /** How many of it; 0 where counting makes no sense. */
  count: number;
}

/** What is known of a failure. */
export interface ErrorFacts {
  reason?: ErrorReason;
  metadata?: Record<string, string>;
  retryMs?: number;
  warnings?: Warning[];
  cause?: unknown;
}

/** Every failure of a call: the server's, the connection's, and options that cannot be sent. */
export class CapfitError extends Error {
  override readonly name = "CapfitError";
  readonly code: StatusCode;
  /** Not there where no server answered. */
  readonly reason: ErrorReason | undefined;
  /** The member at fault as a path in the request, e.g. "options.budget.max_primitives". */
  readonly field: string | undefined;
  /** What it is. */
  readonly value: string | undefined;
  /** What it may be. */
  readonly limit: string | undefined;
  /** All facts by name: those above, `line`, or `element` and `row`, for files. */
  readonly metadata: Readonly<Record<string, string>>;
  /** How long the server asks to wait before the next attempt; negative: no further attempt. */
  readonly retryMs: number | undefined;
  /** What had been noticed before the call failed. */
  readonly warnings: readonly Warning[];

  constructor(code: StatusCode, message: string, facts: ErrorFacts = {}) {
    super(message, facts.cause === undefined ? undefined : { cause: facts.cause });
    this.code = code;
    this.reason = facts.reason;
    this.metadata = facts.metadata ?? {};
    this.field = this.metadata["field"];
    this.value = this.metadata["value"];
    this.limit = this.metadata["limit"];
    this.retryMs = facts.retryMs;
    this.warnings = facts.warnings ?? [];
  }
}

/** An argument that is refused before anything is sent, in the form in which the server says it. */
export function invalidField(
  reason: ErrorReason,
  field: string,
  problem: string,
  value?: unknown,
  limit?: string,
): CapfitError {
  const metadata: Record<string, string> = { field };
  if (value !== undefined) metadata["value"] = String(value);
  if (limit !== undefined) metadata["limit"] = limit;
  const was = value === undefined ? "" : `, is ${String(value)}`;
  return new CapfitError("INVALID_ARGUMENT", `${field} ${problem}${was}`, { reason, metadata });
}

/** The server's answer is not what the contract promises. */
export function brokenContract(problem: string): CapfitError {
  return new CapfitError("INTERNAL", `the server's answer breaks the contract: ${problem}`);
}

/** The caller's signal was aborted. */
export function cancelled(signal: AbortSignal): CapfitError {
  return new CapfitError("CANCELLED", "the call was aborted by its signal", {
    reason: "CANCELLED",
    cause: signal.reason,
  });
}

/** What a failed call's status and trailers say. */
export function fromServiceError(error: ServiceError, address: string): CapfitError {
  const code = StatusNumber[error.code] as StatusCode;
  const facts = factsOf(error.metadata);
  if (facts.reason === undefined) {
    // Said by this side, before the server could: it knows no more than the code.
    if (code === "DEADLINE_EXCEEDED" || code === "CANCELLED") facts.reason = code;
    if (code === "UNAVAILABLE") {
      const advice = "is capfit-server running, and is this its address?";
      return new CapfitError(code, `cannot reach ${address}: ${error.details} (${advice})`, facts);
    }
  }
  return new CapfitError(code, error.details, facts);
}

function factsOf(trailers: Metadata): ErrorFacts {
  const facts: ErrorFacts = { warnings: [] };
  for (const bytes of trailers.get("grpc-status-details-bin")) {
    for (const detail of RichStatus.deserialize(bytes as Buffer).details) {
      const { type_url: url, value } = detail as unknown as { type_url: string; value: Buffer };
      addDetail(url.slice(url.lastIndexOf("/") + 1), value, facts);
    }
  }
  const pushback = trailers.get("grpc-retry-pushback-ms")[0];
  if (pushback !== undefined) {
    // What is no number of milliseconds means "do not try again", by gRPC's rules.
    facts.retryMs = /^\d+$/.test(String(pushback)) ? Number(pushback) : -1;
  }
  return facts;
}

function addDetail(type: string, bytes: Buffer, facts: ErrorFacts): void {
  if (type === "google.rpc.ErrorInfo") {
    const info = DetailMessages[type].deserialize(bytes);
    facts.reason = info.reason;
    facts.metadata = { ...info.metadata };
  } else if (type === "google.rpc.RetryInfo") {
    facts.retryMs = millisecondsOf(DetailMessages[type].deserialize(bytes));
  } else if (type === "capfit.v1.Warning") {
    facts.warnings?.push(DetailMessages[type].deserialize(bytes));
  }
}

function millisecondsOf(retry: RetryInfo__Output): number {
  const delay = retry.retryDelay;
  return delay === null ? 0 : Number(delay.seconds) * 1e3 + delay.nanos / 1e6;
}
