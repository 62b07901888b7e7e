"""Files as disks, editors and people spoil them."""

import re

ODD_NUMBERS = b"nan inf -inf 1e999 -1e999 1e-999 -0.0 0x10 1_0 5e-324 1.7976931348623157e308 1,5"
ODD_WORDS = b'true "" [1] [] {} null 1979-05-27 \' " \xff \x00 \xef\xbb\xbf'
ODD_TEXTS = (
    *ODD_NUMBERS.split(b" "),
    *ODD_WORDS.split(b" "),
    *(b'"24 degF"', b'"3000 rpm"', b'"1 bar"', b'"1 MPa"', b"1 2", b""),
    *(b"9" * 400, b"9" * 5000, b"[" * 3000, b'{"a":' * 3000),
)
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")


def bits(rng, data):
    """Return the bytes with some bits flipped, or cut, or with a piece lost, doubled or moved."""
    data = bytearray(data)
    kind = rng.randrange(7)
    a, b = sorted(rng.randrange(len(data) + 1) for _ in range(2))
    if kind < 3 and data:
        for _ in range(rng.choice([1, 1, 1, 2, 8])):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif kind == 3:
        del data[rng.randrange(len(data) + 1) :]
    elif kind == 4:
        del data[a : min(b, a + rng.choice([1, 4, 40]))]
    elif kind == 5:
        data[a:a] = data[a : min(b, a + 100)]
    else:
        data[a:a] = rng.randbytes(rng.choice([1, 8, 200]))
    return bytes(data)


def text(rng, data):
    """Return a text spoiled as people do it, or as ``bits`` does."""
    kind = rng.randrange(6)
    lines = data.split(b"\n")
    spot = rng.randrange(len(lines))
    if kind == 0:
        return bits(rng, data)
    if kind == 1:  # a number becomes something else
        found = list(NUMBER.finditer(data))
        if not found:
            return data
        one = rng.choice(found)
        return data[: one.start()] + rng.choice(ODD_TEXTS) + data[one.end() :]
    if kind == 2:
        lines[spot] = b""
    elif kind == 3:
        lines.insert(rng.randrange(len(lines)), lines[spot])
    elif kind == 4:  # what stands behind the sign is another's
        other = rng.choice(lines)
        lines[spot] = re.sub(rb"(=|:).*", b"", lines[spot]) + (other.partition(b"=")[2] or other)
    else:
        word = re.findall(rb"\w+", lines[spot])
        if word:
            chosen = rng.choice(word)
            lines[spot] = lines[spot].replace(
                chosen, rng.choice([chosen[:-1], chosen * 2, b"x"]), 1
            )
    return b"\n".join(lines)
