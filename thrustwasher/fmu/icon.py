"""The icon of a model, drawn without a drawing package so that its bytes never change."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

SIZE = 200
FINE = 4  # drawn this much larger, then averaged: smooth edges
INK, STEEL, OIL = (38, 50, 66), (120, 144, 168), (214, 140, 40)
Mask = NDArray[np.bool_]
Reals = NDArray[np.float64]
Shapes = list[tuple[Mask, tuple[int, int, int]]]


def icon(model: str) -> bytes:
    """Return a PNG of 200 x 200 pixels with a transparent ground."""
    x, y = np.meshgrid(*[(np.arange(SIZE * FINE) + 0.5) / (SIZE * FINE) * 2 - 1] * 2)
    draw = {"ThrustWasher": _washer, "ShiftTransmission": _train, "GearMesh": _mesh}
    canvas = np.zeros((SIZE * FINE, SIZE * FINE, 4))
    for mask, colour in draw.get(model, _pack)(x, y):
        canvas[mask] = (*colour, 255)
    small = canvas.reshape(SIZE, FINE, SIZE, FINE, 4).mean(axis=(1, 3))
    colour = small[..., :3] * 255 / np.maximum(small[..., 3:], 1)
    return _png(np.concatenate([colour, small[..., 3:]], axis=2).round().astype(np.uint8))


def _ring(x: Reals, y: Reals, inner: float, outer: float) -> Mask:
    radius = np.hypot(x, y)
    return np.asarray((radius > inner) & (radius < outer))


def _washer(x: Reals, y: Reals) -> Shapes:
    film = _ring(x, y, 0.50, 0.86) & (np.arctan2(y, x) > -2.4) & (np.arctan2(y, x) < -0.7)
    return [(_ring(x, y, 0.36, 0.95), INK), (_ring(x, y, 0.42, 0.89), STEEL), (film, OIL)]


def _pack(x: Reals, y: Reals) -> Shapes:
    shapes: Shapes = [(np.asarray((abs(x) < 0.95) & (abs(y) < 0.13)), INK)]
    for i, place in enumerate(np.linspace(-0.7, 0.7, 6)):
        side = 1 if i % 2 else -1
        plate = (abs(x - place) < 0.1) & (abs(y) > 0.17) & (abs(y) < (0.9 if side > 0 else 0.78))
        shapes.append((np.asarray(plate), STEEL if side > 0 else OIL))
    return shapes


def _mesh(x: Reals, y: Reals) -> Shapes:
    return [*_gear(x + 0.42, y, 0.46, 14, STEEL), *_gear(x - 0.5, y, 0.38, 12, OIL)]


def _train(x: Reals, y: Reals) -> Shapes:
    shapes = [(_ring(x, y, 0.84, 0.96), INK), *_gear(x, y, 0.3, 12, OIL)]
    for angle in (np.pi / 2, np.pi * 7 / 6, np.pi * 11 / 6):
        shapes += _gear(x - 0.59 * np.cos(angle), y + 0.59 * np.sin(angle), 0.22, 10, STEEL)
    return shapes


def _gear(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    radius: float,
    teeth: int,
    colour: tuple[int, int, int],
) -> Shapes:
    edge = radius + 0.04 * np.sign(np.cos(teeth * np.arctan2(y, x)))
    body = np.asarray(np.hypot(x, y) < edge)
    return [(body, colour), (_ring(x, y, -1.0, 0.3 * radius), INK)]


def _png(pixels: NDArray[np.uint8]) -> bytes:
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    parts = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)),
        (b"IDAT", zlib.compress(rows, 9)),
        (b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in parts
    )
