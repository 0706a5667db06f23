// Calls a capfit server.
import {
  type ChannelCredentials, type ClientDuplexStream, type Metadata, type ServiceError,
} from "@grpc/grpc-js";
import { Readable } from "node:stream";

import { checkNames, checkObject, numberOf, stringOf } from "./checks";
import {
  type Security, SECURITY_NAMES, channelOptions, credentialsOf, metadataOf, targetOf, withPort,
} from "./connection";
import { BodyService } from "./contract";
import { CapfitError, cancelled, fromServiceError, invalidField } from "./errors";
import { EXTRA_NAMES, type Extras, exportsToWire, layoutToWire } from "./extras";
import type { ApproximateBodyHeader } from "./generated/capfit/v1/ApproximateBodyHeader";
import type { ApproximateBodyRequest } from "./generated/capfit/v1/ApproximateBodyRequest";
import type {
  ApproximateBodyResponse__Output,
} from "./generated/capfit/v1/ApproximateBodyResponse";
import type {
  BodyApproximationServiceClient,
} from "./generated/capfit/v1/BodyApproximationService";
import type { GetServerInfoResponse__Output } from "./generated/capfit/v1/GetServerInfoResponse";
import { type Mesh, type Upload, uploadOf } from "./mesh";
import { type FitOptions, optionsToWire } from "./options";
import type { Result, ServerInfo } from "./result";
import { type ProgressFunction, ResultCollector } from "./result_collector";
import { serverInfoOf } from "./result_conversion";
import { withRetries } from "./retries";

const FIT_TIMEOUT_MS = 300_000;
const INFO_TIMEOUT_MS = 10_000;

/** What may be set about the connection. */
export interface ClientOptions extends Security {
  /** In place of all about TLS below. Default: without TLS, as capfit-server listens. */
  credentials?: ChannelCredentials;
}

/** What may be set about every call. */
export interface InfoOptions {
  /** Time for the whole call with all attempts; above 0. Default: 300000, serverInfo() 10000. */
  timeoutMs?: number;
  /** Stops the call, the server's work too. */
  signal?: AbortSignal;
}

/** What may be set about one fit. */
export interface CallOptions extends InfoOptions, Extras {
  /** Called for each progress message. What it throws ends the call. */
  onProgress?: ProgressFunction;
  /** The caller's name for the job: at most 128 bytes, it stands in the server's logs. */
  requestId?: string;
}

type Stream = ClientDuplexStream<ApproximateBodyRequest, ApproximateBodyResponse__Output>;

// What holds for all attempts of a call.
interface Limits {
  deadline: number;
  signal: AbortSignal | undefined;
}

/**
 * A connection to one server; calls may run side by side.
 *
 * Every failure is a CapfitError. A server that is full or cannot be reached is asked up to four
 * times, with the pauses that it names, within the time of the call.
 */
export class CapfitClient {
  private readonly address: string;
  private readonly metadata: Metadata;
  private readonly stub: BodyApproximationServiceClient;

  /**
   * `address`: HOST or HOST:PORT, port 50051 where none is told. Connects with the first call.
   * Several share the calls: numeric addresses with commas between, or all that DNS knows of a name,
   * "dns:///HOST:PORT".
   */
  constructor(address: string, options: ClientOptions = {}) {
    checkNames(options, ["credentials", ...SECURITY_NAMES], "client");
    this.address = stringOf(address, "address").split(",").map(withPort).join(",");
    this.metadata = metadataOf(options);
    this.stub = new BodyService(
      targetOf(this.address), options.credentials ?? credentialsOf(options),
      channelOptions(options));
  }

  /** Fits spheres and capsules to a body. */
  async approximate(mesh: Mesh, options: FitOptions = {}, call: CallOptions = {}): Promise<Result> {
    const upload = uploadOf(mesh);
    const header: ApproximateBodyHeader = { mesh: upload.header, options: optionsToWire(options) };
    const limits = limitsOf(call, FIT_TIMEOUT_MS, ["onProgress", "requestId", ...EXTRA_NAMES]);
    if (call.requestId !== undefined) header.requestId = stringOf(call.requestId, "request_id");
    if (call.layout !== undefined) header.layout = layoutToWire(call.layout);
    if (call.exports !== undefined) header.exports = exportsToWire(call.exports);
    return this.attempts(limits, () => {
      const wantsPolygons = options.wantFeaturePolygons === true;
      const collector = new ResultCollector(call.onProgress, wantsPolygons);
      return this.tryOnce(header, upload, limits, collector);
    });
  }

  /** What the server is and what it accepts. */
  async serverInfo(call: InfoOptions = {}): Promise<ServerInfo> {
    const limits = limitsOf(call, INFO_TIMEOUT_MS, []);
    const info = await this.attempts(limits, () => this.askInfo(limits));
    return serverInfoOf(info);
  }

  /** Ends the connection. Calls that are under way are finished, later ones fail. */
  close(): void {
    this.stub.close();
  }

  private async attempts<Value>(limits: Limits, attempt: () => Promise<Value>): Promise<Value> {
    return withRetries(limits.deadline, limits.signal, async () => {
      try {
        return await attempt();
      } catch (error) {
        if (!isServiceError(error)) throw error;
        if (limits.signal?.aborted) throw cancelled(limits.signal);
        throw fromServiceError(error, this.address);
      }
    });
  }

  private async tryOnce(
    header: ApproximateBodyHeader, upload: Upload, limits: Limits, collector: ResultCollector,
  ): Promise<Result> {
    const stream: Stream = this.stub.approximateBody(this.metadata, { deadline: limits.deadline });
    const stop = () => stream.cancel();
    limits.signal?.addEventListener("abort", stop, { once: true });
    stream.on("error", () => undefined);  // the loop sees it; later ones have nobody left to tell
    try {
      Readable.from(requests(header, upload)).pipe(stream as unknown as NodeJS.WritableStream);
      for await (const response of stream) collector.add(response);
      return collector.finish();
    } catch (error) {
      stream.cancel();
      throw error;
    } finally {
      limits.signal?.removeEventListener("abort", stop);
    }
  }

  private askInfo(limits: Limits): Promise<GetServerInfoResponse__Output> {
    return new Promise((resolve, reject) => {
      const answered = (error: ServiceError | null, info?: GetServerInfoResponse__Output) => {
        limits.signal?.removeEventListener("abort", stop);
        if (info !== undefined) resolve(info);
        else reject(error);
      };
      const call = this.stub.getServerInfo(
        {}, this.metadata, { deadline: limits.deadline }, answered);
      const stop = () => call.cancel();
      limits.signal?.addEventListener("abort", stop, { once: true });
    });
  }
}

function* requests(
  header: ApproximateBodyHeader, upload: Upload,
): Generator<ApproximateBodyRequest> {
  yield { header };
  for (const chunk of upload.chunks()) yield { chunk };
}

function limitsOf(call: InfoOptions, timeoutMs: number, others: readonly string[]): Limits {
  checkObject(call, "call");
  checkNames(call, ["timeoutMs", "signal", ...others], "call");
  const time = numberOf(call.timeoutMs ?? timeoutMs, "call.timeoutMs");
  if (!(time > 0)) throw invalidField("OUT_OF_RANGE", "call.timeoutMs", "must be above 0", time);
  return { deadline: Date.now() + time, signal: call.signal };
}

function isServiceError(error: unknown): error is ServiceError {
  return error instanceof Error && !(error instanceof CapfitError) && "metadata" in error &&
    "details" in error;
}
