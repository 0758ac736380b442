"""The bits of a frame on the bus, written out one by one as ISO 11898-1 has them."""

from host_sim.protocol.codec import Frame


def crc15(bits: str) -> int:
    """The CRC of CAN 2.0 over bits."""
    crc = 0
    for bit in bits:
        crc = ((crc << 1) & 0x7FFF) ^ (0x4599 if int(bit) ^ (crc >> 14) else 0)
    return crc


def bits_sent(frame: Frame) -> str:
    """All bits of a frame, with stuff bits and the gap before the next one."""
    bits = f"0{frame.id:011b}000{len(frame.data):04b}" + "".join(f"{byte:08b}" for byte in frame.data)
    sent = ""
    for bit in f"{bits}{crc15(bits):015b}":
        sent += bit
        if sent[-5:] in ("00000", "11111"):
            sent += "1" if bit == "0" else "0"
    return sent + "1" + "01" + "1" * 7 + "1" * 3
