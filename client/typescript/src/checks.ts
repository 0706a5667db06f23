// Checks of what JavaScript lets through and protobufjs would change without a word: unknown names
// are dropped, fractions cut off, strings made numbers. Ranges are the server's to check.
import { invalidField } from "./errors";

const plain = (name: string): string => name.replaceAll("_", "").toLowerCase();

// `path` is where the names stand in the request: "options".
export function checkNames(given: object, known: readonly string[], path: string): void {
  for (const name of Object.keys(given)) {
    if (known.includes(name)) continue;
    const near = known.find((one) => plain(one) === plain(name));
    const advice = near === undefined ? `there are ${known.join(", ")}` : `did you mean ${near}?`;
    throw invalidField("UNKNOWN_VALUE", `${path}.${name}`, `is not known: ${advice}`);
  }
}

export function checkObject(value: unknown, field: string): asserts value is object {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw invalidField("UNKNOWN_VALUE", field, "must be an object", value);
  }
}

export function numberOf(value: unknown, field: string): number {
  if (typeof value !== "number") {
    throw invalidField("UNKNOWN_VALUE", field, `must be a number, is a ${typeof value}`);
  }
  return value;
}

// A whole number of 32 bits.
export function integerOf(value: unknown, field: string): number {
  const number = numberOf(value, field);
  if (!Number.isFinite(number)) throw invalidField("NOT_FINITE", field, "must be finite", number);
  if (number !== (number | 0)) {
    throw invalidField("OUT_OF_RANGE", field, "must be a whole number of 32 bits", number);
  }
  return number;
}

// Digits of a whole number of 64 bits without sign: a number up to 2^53, or a bigint.
export function unsigned64Of(value: unknown, field: string): string {
  const isWhole = typeof value === "bigint" || Number.isSafeInteger(value);
  if (!isWhole || BigInt(value as number) < 0n || BigInt(value as number) >= 2n ** 64n) {
    const limit = "a whole number in [0, 2^53) or a bigint in [0, 2^64)";
    throw invalidField("OUT_OF_RANGE", field, `must be ${limit}`, value, limit);
  }
  return String(value);
}

export function booleanOf(value: unknown, field: string): boolean {
  if (typeof value !== "boolean") {
    throw invalidField("UNKNOWN_VALUE", field, "must be true or false", value);
  }
  return value;
}

export function stringOf(value: unknown, field: string): string {
  if (typeof value !== "string") {
    throw invalidField("UNKNOWN_VALUE", field, `must be a string, is a ${typeof value}`);
  }
  return value;
}
