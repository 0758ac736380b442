/* What browsers have and the compiler's library does not know yet. */

declare class DecompressionStream implements GenericTransformStream {
  constructor(format: "deflate");
  readonly readable: ReadableStream;
  readonly writable: WritableStream;
}

interface CanvasPath {
  roundRect(x: number, y: number, width: number, height: number, radius: number): void;
}
