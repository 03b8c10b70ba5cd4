"""A reader of 16-bit grey PNG images: levels, texts and pixels per metre."""

import dataclasses
import pathlib
import struct
import zlib

import numpy

SIGNATURE = b"\x89PNG\r\n\x1a\n"
BYTES_A_PIXEL = 2


@dataclasses.dataclass
class PngFile:
    levels: numpy.ndarray  # the first row is the top of the image
    texts: list  # (key, value)
    pixels_per_metre: tuple


def chunks_of(content):
    """The chunks (type, data); a wrong checksum is an error."""
    at = len(SIGNATURE)
    while at < len(content):
        length, kind = struct.unpack(">I4s", content[at:at + 8])
        data = content[at + 8:at + 8 + length]
        if struct.pack(">I", zlib.crc32(kind + data)) != content[at + 8 + length:at + 12 + length]:
            raise ValueError(f"checksum of {kind}")
        yield kind, data
        at += 12 + length


def predictor(kind, left, up, corner):
    """What a row's filter adds to a byte: nothing, left, up, their mean or Paeth's choice."""
    if kind < 4:
        return (0, left, up, (left + up) // 2)[kind]
    estimate = left + up - corner
    return min((left, up, corner), key=lambda value: abs(estimate - value))


def unfiltered(data, width, height):
    length = BYTES_A_PIXEL * width
    rows = [bytes(length)]
    for number in range(height):
        kind, line = data[number * (length + 1)], data[number * (length + 1) + 1:(number + 1) * (length + 1)]
        row = bytearray(length)
        for i, byte in enumerate(line):
            before = i - BYTES_A_PIXEL
            left, corner = (row[before], rows[-1][before]) if before >= 0 else (0, 0)
            row[i] = (byte + predictor(kind, left, rows[-1][i], corner)) % 256
        rows.append(bytes(row))
    return numpy.frombuffer(b"".join(rows[1:]), dtype=">u2").reshape(height, width)


def text_of(kind, data):
    """Key and value of a text chunk: Latin-1, or UTF-8 after flags, language and translated key."""
    key, _, rest = data.partition(b"\0")
    if kind == b"iTXt":
        return key.decode("latin-1"), rest[2:].split(b"\0", 2)[2].decode("utf-8")
    return key.decode("latin-1"), rest.decode("latin-1")


def read_png(file):
    content = pathlib.Path(file).read_bytes()
    if not content.startswith(SIGNATURE):
        raise ValueError(f"{file} begins with {content[:8]}")
    packed, texts, density = b"", [], None
    for kind, data in chunks_of(content):
        if kind == b"IHDR":
            width, height, *rest = struct.unpack(">IIBBBBB", data)
            if rest != [16, 0, 0, 0, 0]:
                raise ValueError(f"{file}: not 16-bit grey without interlacing: {rest}")
        elif kind == b"IDAT":
            packed += data
        elif kind in (b"tEXt", b"iTXt"):
            texts.append(text_of(kind, data))
        elif kind == b"pHYs":
            density = struct.unpack(">II", data[:8])
    return PngFile(unfiltered(zlib.decompress(packed), width, height), texts, density)
