import type * as medial from "./index.js";

/** An axis, a line or a shape as plain data. */
export interface PlainAxis {
  nodes: Record<string, Float64Array | Uint32Array | Uint8Array>;
  edges: Record<string, Float64Array | Uint32Array | Uint8Array>;
  sites: Record<string, Float64Array | Uint32Array | Uint8Array>;
  method: string;
  tolerance: number;
  resolution: number;
  length: number;
  branchCount: number;
  /** Each branch as rows of x, y, radius. */
  lines: Float64Array[];
}
export interface PlainShape { area: number; bounds: [number, number, number, number]; polygons: medial.Position[][][] }
export interface PlainLine { length: number; narrowest: number; closed: boolean; coordinates: number[][] }

type Plain<T> = T extends medial.MedialAxis ? PlainAxis
  : T extends medial.Shape ? PlainShape
  : T extends medial.Line ? PlainLine
  : T extends (infer U)[] ? Plain<U>[]
  : T;
type Functions = { [K in keyof typeof medial as (typeof medial)[K] extends (...given: never[]) => unknown ? K : never]:
  (typeof medial)[K] extends (...given: infer A) => infer R ? (...given: A) => Promise<Plain<Awaited<R>>> : never };

type Columns<T> = T extends medial.Records ? Omit<T, keyof medial.Records> : T;
type Methods =
  | "move" | "insert" | "remove" | "setBulge" | "insertLoop" | "removeLoop" | "moveLoop" | "undo"
  | "vertex" | "bulge" | "nodes" | "edges" | "sites";
/** An editor that stays in the worker. */
export type RemoteEditor = {
  [K in Methods]: (...given: Parameters<medial.Editor[K]>) => Promise<Columns<ReturnType<medial.Editor[K]>>>;
} & { readonly axis: Promise<PlainAxis>; copy(): Promise<RemoteEditor>; free(): Promise<void> };

export type WorkerModule = Functions & {
  Editor(...given: ConstructorParameters<typeof medial.Editor>): Promise<RemoteEditor>;
  /** Ends the worker, and rejects all pending calls. */
  terminate(): void;
};
/**
 * Starts a worker whose methods are the functions of the package, each giving a promise. It computes on `threads`
 * threads (1); 0: as many as the machine has. On one where workers cannot share memory.
 */
export function inWorker(options?: { threads?: number }): Promise<WorkerModule>;
