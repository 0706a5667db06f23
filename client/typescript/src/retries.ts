// Attempts, until one succeeds or another is of no use.
import { setTimeout as sleep } from "node:timers/promises";

import { CapfitError, cancelled } from "./errors";

const MAX_ATTEMPTS = 4;
const FIRST_PAUSE_MS = 200;

// How long to wait before the next attempt: what the server asked for, else twice as long each
// time. undefined: another attempt is of no use.
function pauseAfter(error: unknown, attempt: number): number | undefined {
  if (!(error instanceof CapfitError) || attempt === MAX_ATTEMPTS) return undefined;
  if (error.code !== "UNAVAILABLE" && error.code !== "RESOURCE_EXHAUSTED") return undefined;
  if (error.retryMs !== undefined) return error.retryMs < 0 ? undefined : error.retryMs;
  return error.code === "UNAVAILABLE" ? FIRST_PAUSE_MS * 2 ** (attempt - 1) : undefined;
}

// An attempt that could only begin after the deadline (milliseconds since 1970) is not made.
export async function withRetries<Value>(
  deadline: number,
  signal: AbortSignal | undefined,
  attempt: () => Promise<Value>,
): Promise<Value> {
  for (let number = 1; ; number++) {
    if (signal?.aborted) throw cancelled(signal);
    try {
      return await attempt();
    } catch (error) {
      const pause = pauseAfter(error, number);
      if (pause === undefined || Date.now() + pause >= deadline) throw error;
      // An abort ends the pause; the next turn of the loop says so.
      await sleep(pause, undefined, { signal }).catch(() => undefined);
    }
  }
}
