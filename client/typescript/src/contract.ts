// The contract at run time: the service's stub, and the messages that an error's details hold.
import { loadPackageDefinition } from "@grpc/grpc-js";
import { loadSync } from "@grpc/proto-loader";
import path from "node:path";

import type { ProtoGrpcType as DetailTypes } from "./generated/error_details";
import type { ProtoGrpcType as ServiceTypes } from "./generated/service";
import type { ProtoGrpcType as StatusTypes } from "./generated/status";

// The generated types hold for exactly these settings: package.json names them again for the
// generator.
const definition = loadSync(
  ["capfit/v1/service.proto", "google/rpc/status.proto", "google/rpc/error_details.proto"],
  {
    includeDirs: [path.join(__dirname, "..", "proto")],
    longs: Number,
    enums: String,
    defaults: true,
    oneofs: true,
  },
);

const packages = loadPackageDefinition(definition) as unknown as ServiceTypes &
  StatusTypes &
  DetailTypes;

export const BodyService = packages.capfit.v1.BodyApproximationService;
export const RichStatus = packages.google.rpc.Status;
export const DetailMessages = {
  "google.rpc.ErrorInfo": packages.google.rpc.ErrorInfo,
  "google.rpc.RetryInfo": packages.google.rpc.RetryInfo,
  "capfit.v1.Warning": packages.capfit.v1.Warning,
};
