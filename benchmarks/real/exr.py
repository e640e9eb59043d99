"""Reads the EXR files that kaustik writes, and writes smaller ones: half floats in ZIP compression. Needs only Python 3.
Handled: scan lines, 16- and 32-bit floats, no compression, run lengths or ZIP. Not handled: tiles, several parts, other formats."""
import array
import dataclasses
import itertools
import struct
import zlib

MAGIC = 20000630
HALF, FLOAT = 1, 2
RUN_LENGTHS = 1
LINES_OF_A_BLOCK = {0: 1, RUN_LENGTHS: 1, 2: 1, 3: 16}  # by compression: none, run lengths, ZIP of one line, ZIP of 16
LARGEST_HALF = 65504.0


@dataclasses.dataclass
class Picture:
    width: int
    height: int
    channels: dict  # by name: all numbers of that channel, row by row

    def mean(self, layer):
        """The mean over the pixels and the channels R, G, B of a layer; "" is the picture itself."""
        values = self.colours(layer)
        return sum(map(sum, values)) / max(1, sum(map(len, values)))

    def colours(self, layer):
        return [self.channels[f"{layer}.{letter}" if layer else letter] for letter in "RGB"]

    def has(self, layer):
        return f"{layer}.R" in self.channels


def read(path):
    with open(path, "rb") as file:
        data = file.read()
    magic, version = struct.unpack_from("<ii", data)
    if magic != MAGIC or version & 0x1a00:  # tiles, deep data, several parts
        raise ValueError(f"{path}: not an EXR file of scan lines")
    header, at = read_header(data, 8)
    compression = header["compression"][0]
    if compression not in LINES_OF_A_BLOCK:
        raise ValueError(f"{path}: compression {compression} cannot be read")
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES_OF_A_BLOCK[compression]
    formats = list(channels_in(header["channels"]))
    columns = {name: array.array("f") for name, _ in formats}
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        rows = min(lines, y1 + 1 - y)
        raw = rows * width * sum(2 * kind for _, kind in formats)
        append_rows(columns, formats, unpacked(data[offset + 8:offset + 8 + size], raw, compression), rows, width)
    return Picture(width, height, columns)


def read_header(data, at):
    header = {}
    while data[at] != 0:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return header, at + 1


def text_at(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def channels_in(attribute):
    at = 0
    while attribute[at] != 0:
        name, at = text_at(attribute, at)
        kind = struct.unpack_from("<i", attribute, at)[0]
        if kind not in (HALF, FLOAT):
            raise ValueError(f"channel {name} is not of floats")
        yield name, kind  # a number takes 2 kind bytes
        at += 16


def append_rows(columns, formats, block, rows, width):
    at = 0
    for _ in range(rows):
        for name, kind in formats:
            letter, size = ("e", 2) if kind == HALF else ("f", 4)
            columns[name].extend(struct.unpack_from(f"<{width}{letter}", block, at))
            at += size * width


def runs(block):
    """Run lengths in EXR: a count below 0 precedes that many bytes, another one a byte that is repeated one time more."""
    out, at = bytearray(), 0
    while at < len(block):
        count = struct.unpack_from("b", block, at)[0]
        if count < 0:
            out += block[at + 1:at + 1 - count]
            at += 1 - count
        else:
            out += block[at + 1:at + 2] * (count + 1)
            at += 2
    return out


def unpacked(block, raw, compression):
    """In EXR: deflate or run lengths, then sums, then both halves interleaved. A block that would not shrink is stored as it is."""
    if len(block) == raw:
        return block
    differences = runs(block) if compression == RUN_LENGTHS else zlib.decompress(block)
    summed = bytes(itertools.accumulate(differences, lambda a, b: (a + b - 128) & 255))
    out = bytearray(raw)
    out[0::2], out[1::2] = summed[:(raw + 1) // 2], summed[(raw + 1) // 2:]
    return bytes(out)


def packed(block):
    halves = block[0::2] + block[1::2]
    differences = bytes([halves[0], *((b - a + 128) & 255 for a, b in zip(halves, halves[1:]))])
    shrunk = zlib.compress(differences)
    return shrunk if len(shrunk) < len(block) else block


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_half(path, picture, comments=""):
    """Writes all channels as half floats; larger numbers become the largest half, 65504."""
    names = sorted(picture.channels)
    width, height = picture.width, picture.height
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    rows_of_channels = b"".join(n.encode() + b"\0" + struct.pack("<iiii", HALF, 0, 1, 1) for n in names) + b"\0"
    header = struct.pack("<ii", MAGIC, 2 | (0x400 if any(len(n) > 31 for n in names) else 0)) + b"".join([
        attribute("channels", "chlist", rows_of_channels), attribute("comments", "string", comments.encode()),
        attribute("compression", "compression", b"\3"), attribute("dataWindow", "box2i", window),
        attribute("displayWindow", "box2i", window), attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1))]) + b"\0"
    halves = {n: as_halves(picture.channels[n]) for n in names}
    blocks = []
    for y in range(0, height, 16):
        rows = range(y, min(y + 16, height))
        block = packed(b"".join(halves[n][2 * row * width:2 * (row + 1) * width] for row in rows for n in names))
        blocks.append(struct.pack("<ii", y, len(block)) + block)
    starts = itertools.accumulate((len(b) for b in blocks[:-1]), initial=len(header) + 8 * len(blocks))
    with open(path, "wb") as file:
        file.write(header + struct.pack(f"<{len(blocks)}Q", *starts) + b"".join(blocks))


def as_halves(values):
    return struct.pack(f"<{len(values)}e", *(v if v != v else max(-LARGEST_HALF, min(LARGEST_HALF, v)) for v in values))
