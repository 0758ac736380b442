/* Declarations of what browsers have and the compiler's library does not have yet. */

declare class DecompressionStream implements GenericTransformStream {
  constructor(format: "deflate");
  readonly readable: ReadableStream;
  readonly writable: WritableStream;
}

declare module "rp2040js" {
  export const RP2040: new () => object;
}
