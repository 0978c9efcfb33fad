"""Every encoding to pixels; broken data to one line."""

import struct
import subprocess
import sys
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from image_pixels import ImageError, compressed, decode_rvl, picture_of, raw

RGB = np.zeros((4, 6, 3), np.uint8)
RGB[:, :2], RGB[:, 2:4], RGB[:, 4:] = (255, 0, 0), (0, 255, 0), (0, 0, 255)


def read(pixels, encoding, **more):
    pixels = np.ascontiguousarray(pixels)
    return raw(encoding, pixels.shape[0], pixels.shape[1], pixels.strides[0], pixels.tobytes(), **more)


def seen(pixels, encoding, **more):
    picture = read(pixels, encoding, **more)
    assert picture.unit == 0.0 and picture.pixels.dtype == np.uint8
    return picture.pixels


def wide(pixels):
    return pixels.astype(np.uint16) * 257


@pytest.mark.parametrize(
    "encoding, pixels",
    [
        ("rgb8", RGB),
        ("bgr8", RGB[..., ::-1].copy()),
        ("rgba8", np.dstack((RGB, RGB[..., 0]))),
        ("bgra8", np.dstack((RGB[..., ::-1], RGB[..., 0]))),
        ("8UC3", RGB),
        ("rgb16", wide(RGB)),
        ("bgr16", wide(RGB[..., ::-1].copy())),
        ("8UC4", np.dstack((RGB, RGB[..., 0]))),
    ],
)
def test_colours(encoding, pixels):
    assert (seen(pixels, encoding) == RGB).all()


def test_greys():
    grey = np.arange(24, dtype=np.uint8).reshape(4, 6)
    assert (seen(grey, "mono8") == grey).all() and (seen(grey, "8UC1") == grey).all()
    assert (seen(wide(grey), "mono16") == grey).all()
    assert (seen(wide(grey).astype(">u2"), "mono16", big_endian=True) == grey).all()


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
@pytest.mark.parametrize("bits", [8, 16])
def test_bayer(pattern, bits):
    """A mosaic of one colour, whose colour must come back: orange, so that red and blue are not exchanged."""
    colour = {"r": 250, "g": 120, "b": 20}
    tile = np.array([colour[c] for c in pattern], np.uint8).reshape(2, 2)
    mosaic = np.tile(tile, (8, 8))
    picture = seen(mosaic if bits == 8 else wide(mosaic), f"bayer_{pattern}{bits}")
    assert picture.shape == (16, 16, 3) and (picture[4:12, 4:12] == (250, 120, 20)).all()


@pytest.mark.parametrize("encoding, order", [("yuv422", "uyvy"), ("yuv422_yuy2", "yuyv")])
def test_yuv(encoding, order):
    values = {"y": 81, "u": 90, "v": 240}  # red, in the range of video
    pair = np.array([values[c] for c in order], np.uint8)
    pixels = np.tile(pair, (4, 3)).reshape(4, 6, 2)
    assert np.abs(seen(pixels, encoding).astype(int) - (255, 0, 0)).max() < 4


def test_rows_may_be_padded():
    padded = np.zeros((4, 24), np.uint8)
    padded[:, :18] = RGB.reshape(4, 18)
    assert (raw("rgb8", 4, 6, 24, padded.tobytes()).pixels == RGB).all()
    assert (raw("rgb8", 4, 6, 24, padded.tobytes()[:-6]).pixels == RGB).all()


@pytest.mark.parametrize(
    "arguments, said",
    [
        (("rgb8", 4, 6, 17, bytes(72)), "step is 17, but 6 pixels of rgb8 are 18 bytes"),
        (("rgb8", 4, 6, 0, bytes(72)), "step is 0"),
        (("rgb8", 4, 6, 18, bytes(71)), "71 bytes of data, but step 18 and height 4 make 72"),
        (("rgb8", 4, 6, 18, b""), "0 bytes of data"),
        (("mono16", 2, 2, 5, bytes(10)), "step is 5"),
        (("rgb8", 0, 6, 18, b""), "6x0 pixels"),
        (("rgb8", 2**31, 2**31, 2**33, b""), "cannot be shown"),
        (("rgb9", 4, 6, 18, bytes(72)), "encoding 'rgb9' cannot be shown"),
        (("", 4, 6, 18, bytes(72)), "encoding ''"),
        (("32FC3", 4, 6, 72, bytes(288)), "'32FC3' cannot be shown"),
        (("8UC2", 4, 6, 12, bytes(48)), "cannot be shown"),
        (("bayer_rggb8", 1, 6, 6, bytes(6)), "needs two rows"),
        (("yuv422", 4, 5, 10, bytes(40)), "even number of columns"),
    ],
)
def test_broken_images_are_told(arguments, said):
    with pytest.raises(ImageError) as error:
        raw(*arguments)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_colours_without_a_name_are_in_the_order_that_is_asked_for():
    assert (seen(RGB[..., ::-1].copy(), "8UC3", unnamed="bgr") == RGB).all()
    assert (seen(RGB, "rgb8", unnamed="bgr") == RGB).all()


@pytest.mark.parametrize(
    "encoding, kind, unit",
    [("32FC1", "<f4", 1.0), ("64FC1", "<f8", 1.0), ("16UC1", "<u2", 1e-3), ("16SC1", "<i2", 1e-3), ("32SC1", "<i4", 1e-3)],
)
def test_depth_keeps_its_numbers(encoding, kind, unit):
    numbers = np.array([[0, 2, 3], [4, 5, 6]], kind)
    picture = read(numbers, encoding)
    assert picture.unit == unit and picture.pixels.tolist() == numbers.tolist()
    assert read(numbers.astype(kind.replace("<", ">")), encoding, big_endian=True).pixels.tolist() == numbers.tolist()


def test_messages_of_both_types():
    image = SimpleNamespace(encoding="mono8", height=1, width=2, step=2, data=b"\x01\x02", is_bigendian=0)
    assert picture_of(image).pixels.tolist() == [[1, 2]]
    packed = SimpleNamespace(format="mono8; png compressed", data=encoded(".png", np.array([[1, 2]], np.uint8)))
    assert picture_of(packed).pixels.tolist() == [[1, 2]]


def test_plain_pictures_need_no_opencv():
    code = (
        "import sys, image_pixels; image_pixels.raw('bgra8', 1, 1, 4, bytes(4)); image_pixels.raw('16UC1', 1, 1, 2, bytes(2));"
        "sys.exit('cv2' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def encoded(kind, pixels):
    return cv2.imencode(kind, pixels)[1].tobytes()


def unpacked(layout, data):
    picture = compressed(layout, data)
    assert picture.unit == 0.0
    return picture.pixels


def test_compressed():
    assert (unpacked("rgb8; png compressed bgr8", encoded(".png", RGB[..., ::-1])) == RGB).all()
    assert np.abs(unpacked("jpeg", encoded(".jpg", np.full((16, 16, 3), (20, 40, 200), np.uint8))).astype(int) - (200, 40, 20)).max() < 6
    grey = np.arange(24, dtype=np.uint8).reshape(4, 6)
    assert (unpacked("mono8; png compressed", encoded(".png", grey)) == grey).all()
    mosaic = np.tile(np.array([[250, 120], [120, 20]], np.uint8), (8, 8))
    assert (unpacked("bayer_rggb8; png compressed", encoded(".png", mosaic))[4:12, 4:12] == (250, 120, 20)).all()


def test_depth_sent_by_the_transport_for_colours():
    picture = compressed("16UC1; png compressed", encoded(".png", np.array([[0, 5000]], np.uint16)))
    assert (picture.unit, picture.pixels.tolist()) == (1e-3, [[0, 5000]])


def test_compressed_depth():
    head = struct.pack("<iff", 0, 100.0, 1.0)
    picture = compressed("16UC1; compressedDepth", head + encoded(".png", np.array([[0, 5000]], np.uint16)))
    assert (picture.unit, picture.pixels.tolist()) == (1e-3, [[0, 5000]])
    metres = np.array([[2.5, 5.0]], np.float32)
    inverse = np.hstack((100.0 / metres + 1.0, [[0.0]])).astype(np.uint16)
    picture = compressed("32FC1; compressedDepth png", head + encoded(".png", inverse))
    assert picture.unit == 1.0 and np.allclose(picture.pixels[0, :2], (2.5, 5.0), rtol=0.03) and np.isnan(picture.pixels[0, 2])


#: 5 columns, 1 row of the depths 0, 0, 5, 6, 0: two zeros, two others, +5, +1, one zero, no others
RVL = struct.pack("<III", 5, 1, 0x22A12100)


def rvl(pixels):
    """Packs depths, number by number."""
    nibbles, previous, values = [], 0, pixels.ravel().tolist()

    def put(number):
        while True:
            number, low = number >> 3, number & 7
            nibbles.append(low | (8 if number else 0))
            if not number:
                return

    while values:
        zeros = next((i for i, value in enumerate(values) if value), len(values))
        others = next((i for i, value in enumerate(values[zeros:]) if not value), len(values) - zeros)
        put(zeros)
        put(others)
        for value in values[zeros : zeros + others]:
            put((value - previous) << 1 if value >= previous else ((previous - value) << 1) - 1)
            previous = value
        values = values[zeros + others :]
    nibbles += [0] * (-len(nibbles) % 8)
    words = [sum(nibble << 4 * (7 - i) for i, nibble in enumerate(nibbles[n : n + 8])) for n in range(0, len(nibbles), 8)]
    return struct.pack(f"<II{len(words)}I", pixels.shape[1], pixels.shape[0], *words)


def test_depth_compressed_with_rvl():
    assert decode_rvl(RVL).tolist() == [[0, 0, 5, 6, 0]]
    noise = np.random.default_rng(3)
    depth = np.where(noise.random((48, 64)) < 0.3, 0, noise.integers(0, 65536, (48, 64))).astype(np.uint16)
    assert np.array_equal(decode_rvl(rvl(depth)), depth)
    picture = compressed("16UC1; compressedDepth rvl", bytes(12) + rvl(depth))
    assert picture.unit == 1e-3 and np.array_equal(picture.pixels, depth)


@pytest.mark.parametrize(
    "layout, data, said",
    [
        ("jpeg", b"", "0 bytes of 'jpeg' cannot be decoded"),
        ("png", b"\x89PNG\r\n\x1a\nrubbish", "cannot be decoded"),
        ("16UC1; compressedDepth", b"short", "lacks its 12 bytes"),
        ("16UC1; compressedDepth", bytes(40), "cannot be decoded"),
        ("16UC1; compressedDepth rvl", bytes(40), "0x0 pixels"),
        ("16UC1; compressedDepth rvl", bytes(12) + RVL[:8], "cut short"),
        ("16UC1; compressedDepth rvl", bytes(12) + RVL[:8] + b"\xff" * 40, "cut short"),
        ("16UC1; compressedDepth rvl", bytes(12) + struct.pack("<II", 3, 1) + RVL[8:], "no depth image of 3x1"),
    ],
)
def test_broken_compressed_images_are_told(layout, data, said):
    with pytest.raises(ImageError, match=said):
        compressed(layout, data)
