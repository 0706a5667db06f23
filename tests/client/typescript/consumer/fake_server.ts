// A server that answers as a test wants: what a real one cannot be made to say at will.
import {
  Metadata, Server, ServerCredentials, loadPackageDefinition, status,
} from "@grpc/grpc-js";
import { loadSync } from "@grpc/proto-loader";
import path from "node:path";

const packages = loadPackageDefinition(
  loadSync(
    ["capfit/v1/service.proto", "google/rpc/status.proto", "google/rpc/error_details.proto"],
    { includeDirs: [path.join(path.dirname(require.resolve("capfit/package.json")), "proto")] },
  ),
) as any;

export interface Detail {
  type: "google.rpc.ErrorInfo" | "google.rpc.RetryInfo" | "capfit.v1.Warning" | "other.Detail";
  value: object;
}

/** The metadata of an error with these details and this pushback. */
export function trailers(details: Detail[], pushback?: string): Metadata {
  const metadata = new Metadata();
  const messages = {
    "google.rpc.ErrorInfo": packages.google.rpc.ErrorInfo,
    "google.rpc.RetryInfo": packages.google.rpc.RetryInfo,
    "capfit.v1.Warning": packages.capfit.v1.Warning,
    "other.Detail": packages.capfit.v1.Warning,
  };
  const anys = details.map(({ type, value }) => ({
    type_url: `type.googleapis.com/${type}`,
    value: messages[type].serialize(value),
  }));
  metadata.set("grpc-status-details-bin", packages.google.rpc.Status.serialize({ details: anys }));
  if (pushback !== undefined) metadata.set("grpc-retry-pushback-ms", pushback);
  return metadata;
}

/** Either an answer or an error. */
export interface Answer {
  code?: status;
  details?: string;
  metadata?: Metadata;
  /** Messages of ApproximateBodyResponse, or one GetServerInfoResponse. */
  messages?: object[];
}

export class FakeServer {
  calls = 0;
  private readonly server = new Server();

  /** `answer` gets the number of the call, counted from 1. */
  constructor(answer: (call: number) => Answer) {
    this.server.addService(packages.capfit.v1.BodyApproximationService.service, {
      getServerInfo: (_: unknown, done: (error: object | null, value?: object) => void) => {
        const { messages, ...error } = answer(++this.calls);
        if (messages) done(null, messages[0]);
        else done(error);
      },
      approximateBody: (stream: any) => {
        const { messages, ...error } = answer(++this.calls);
        stream.on("error", () => undefined);
        for (const message of messages ?? []) stream.write(message);
        if (error.code !== undefined) stream.emit("error", error);
        else stream.end();
      },
      approximateBodyUnary: () => undefined,
    });
  }

  async start(): Promise<string> {
    const port = await new Promise<number>((resolve, reject) => {
      this.server.bindAsync("127.0.0.1:0", ServerCredentials.createInsecure(), (error, bound) =>
        error ? reject(error) : resolve(bound));
    });
    return `127.0.0.1:${port}`;
  }

  stop(): void {
    this.server.forceShutdown();
  }
}
