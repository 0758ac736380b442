"""A file that is compressed as it is written."""

import zlib
from typing import BinaryIO

COMPRESSED = ".gz"
"""File name suffix of a compressed log."""

_CHUNK_BYTES = 1 << 16
_LEVEL = 1  # compresses a log to a quarter; the default level takes three times as long for a fifth
_GZIP = 16 + zlib.MAX_WBITS


class CompressedFile:
    """Writes a gzip file. If it is cut off anywhere, all but the last 64 kB written before can be read.

    Equal content gives equal bytes, however it is split into writes.
    """

    def __init__(self, file: BinaryIO) -> None:
        """Takes a file that is open for writing; `close` closes it."""
        self._file, self._waiting = file, bytearray()
        self._compressor = zlib.compressobj(_LEVEL, zlib.DEFLATED, _GZIP)
        self._is_empty = True

    @property
    def closed(self) -> bool:
        """Whether it is closed."""
        return self._file.closed

    def write(self, content: bytes) -> None:
        """Appends content; its last part is buffered in memory.

        Raises:
            OSError: It cannot be written.
        """
        self._waiting += content
        while len(self._waiting) >= _CHUNK_BYTES:
            chunk = self._waiting[:_CHUNK_BYTES]
            del self._waiting[:_CHUNK_BYTES]
            self._put(chunk, zlib.Z_SYNC_FLUSH)

    def flush(self) -> None:
        """Writes everything that is buffered.

        Raises:
            OSError: It cannot be written.
        """
        chunk, self._waiting = self._waiting, bytearray()
        self._put(chunk, zlib.Z_SYNC_FLUSH)

    def close(self) -> None:
        """Writes the rest and closes the file. A file to which nothing was written stays empty.

        Raises:
            OSError: It cannot be written; it is closed all the same.
        """
        try:
            if self._waiting or not self._is_empty:
                self._put(self._waiting, zlib.Z_FINISH)
        finally:
            self._file.close()

    def _put(self, chunk: bytearray, mode: int) -> None:
        self._is_empty = self._is_empty and not chunk
        self._file.write(self._compressor.compress(chunk) + self._compressor.flush(mode))
        self._file.flush()
