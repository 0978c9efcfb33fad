"""Every encoding to what is seen; broken data to one line."""
import struct

import cv2
import numpy as np
import pytest
from theora_image_transport.encoder import Encoder

from rqt_image_view.pictures import (COLOR_SCHEMES, DepthView, PictureError, TheoraDecoder, decode_rvl, from_compressed, from_raw,
                                     invert_grid, rotated, show_depth, unrotated_point)

RGB = np.zeros((4, 6, 3), np.uint8)
RGB[:, :2], RGB[:, 2:4], RGB[:, 4:] = (255, 0, 0), (0, 255, 0), (0, 0, 255)


def raw(pixels, encoding, **more):
    pixels = np.ascontiguousarray(pixels)
    return from_raw(encoding, pixels.shape[0], pixels.shape[1], pixels.strides[0], pixels.tobytes(), **more)


def wide(pixels):
    return pixels.astype(np.uint16) * 257


@pytest.mark.parametrize("encoding, pixels", [
    ("rgb8", RGB), ("bgr8", RGB[..., ::-1].copy()), ("rgba8", np.dstack((RGB, RGB[..., 0]))),
    ("bgra8", np.dstack((RGB[..., ::-1], RGB[..., 0]))), ("8UC3", RGB), ("rgb16", wide(RGB)), ("bgr16", wide(RGB[..., ::-1].copy())),
    ("8UC4", np.dstack((RGB, RGB[..., 0])))])
def test_colours(encoding, pixels):
    assert (raw(pixels, encoding) == RGB).all()


def test_greys():
    grey = np.arange(24, dtype=np.uint8).reshape(4, 6)
    assert (raw(grey, "mono8") == grey).all() and (raw(grey, "8UC1") == grey).all()
    assert (raw(wide(grey), "mono16") == grey).all()
    assert (raw(wide(grey).astype(">u2"), "mono16", big_endian=True) == grey).all()


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
@pytest.mark.parametrize("bits", [8, 16])
def test_bayer(pattern, bits):
    """A mosaic of one colour, whose colour must come back: orange, so that red and blue are not exchanged."""
    colour = {"r": 250, "g": 120, "b": 20}
    tile = np.array([colour[c] for c in pattern], np.uint8).reshape(2, 2)
    mosaic = np.tile(tile, (8, 8))
    picture = raw(mosaic if bits == 8 else wide(mosaic), f"bayer_{pattern}{bits}")
    assert picture.shape == (16, 16, 3) and (picture[4:12, 4:12] == (250, 120, 20)).all()


@pytest.mark.parametrize("encoding, order", [("yuv422", "uyvy"), ("yuv422_yuy2", "yuyv")])
def test_yuv(encoding, order):
    values = {"y": 81, "u": 90, "v": 240}  # red, in the range of video
    pair = np.array([values[c] for c in order], np.uint8)
    pixels = np.tile(pair, (4, 3)).reshape(4, 6, 2)
    assert np.abs(raw(pixels, encoding).astype(int) - (255, 0, 0)).max() < 4


def test_rows_may_be_padded():
    padded = np.zeros((4, 24), np.uint8)
    padded[:, :18] = RGB.reshape(4, 18)
    assert (from_raw("rgb8", 4, 6, 24, padded.tobytes()) == RGB).all()
    assert (from_raw("rgb8", 4, 6, 24, padded.tobytes()[:-6]) == RGB).all()


@pytest.mark.parametrize("arguments, said", [
    (("rgb8", 4, 6, 17, bytes(72)), "step is 17, but 6 pixels of rgb8 are 18 bytes"),
    (("rgb8", 4, 6, 0, bytes(72)), "step is 0"),
    (("rgb8", 4, 6, 18, bytes(71)), "71 bytes of data, but step 18 and height 4 make 72"),
    (("rgb8", 4, 6, 18, b""), "0 bytes of data"), (("mono16", 2, 2, 5, bytes(10)), "step is 5"),
    (("rgb8", 0, 6, 18, b""), "6x0 pixels"), (("rgb8", 2 ** 31, 2 ** 31, 2 ** 33, b""), "cannot be shown"),
    (("rgb9", 4, 6, 18, bytes(72)), "encoding 'rgb9' cannot be shown"), (("", 4, 6, 18, bytes(72)), "encoding ''"),
    (("32FC3", 4, 6, 72, bytes(288)), "'32FC3' cannot be shown"), (("8UC2", 4, 6, 12, bytes(48)), "cannot be shown"),
    (("bayer_rggb8", 1, 6, 6, bytes(6)), "needs two rows"), (("yuv422", 4, 5, 10, bytes(40)), "even number of columns")])
def test_broken_images_are_told(arguments, said):
    with pytest.raises(PictureError) as error:
        from_raw(*arguments)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_depth_in_metres_and_millimetres():
    metres = np.array([[0.0, 2.5, 5.0], [10.0, np.nan, np.inf]], np.float32)
    assert raw(metres, "32FC1").tolist() == [[0, 63, 127], [255, 0, 255]]
    millimetres = np.array([[0, 2500, 5000], [10_000, 60_000, 1]], np.uint16)
    assert raw(millimetres, "16UC1").tolist() == [[0, 63, 127], [255, 255, 0]]
    assert raw(metres, "32FC1", depth=DepthView(max_depth=5.0)).tolist() == [[0, 127, 255], [255, 0, 255]]
    assert raw(metres[:, :2], "32FC1", depth=DepthView(dynamic=True)).tolist() == [[0, 63], [255, 0]]


def test_depth_in_colours():
    assert list(COLOR_SCHEMES) == "Gray Autumn Bone Cool Hot Hsv Jet Ocean Pink Rainbow Spring Summer Winter".split()
    picture = show_depth(np.array([[np.nan, 1.0, 9.0]], np.float32), 1.0, DepthView(scheme="Jet"))
    assert picture.shape == (1, 3, 3) and picture[0, 0].tolist() == [0, 0, 0]
    assert picture[0, 1].argmax() == 2 and picture[0, 2].argmax() == 0  # near blue, far red


def test_depth_of_nothing():
    assert show_depth(np.full((2, 2), np.nan, np.float32), 1.0, DepthView(dynamic=True)).tolist() == [[0, 0], [0, 0]]
    assert show_depth(np.zeros((2, 2), np.uint16), 1e-3, DepthView(dynamic=True)).max() == 0


def encoded(kind, pixels):
    return cv2.imencode(kind, pixels)[1].tobytes()


def test_compressed():
    assert (from_compressed("rgb8; png compressed bgr8", encoded(".png", RGB[..., ::-1])) == RGB).all()
    assert np.abs(from_compressed("jpeg", encoded(".jpg", np.full((16, 16, 3), (20, 40, 200), np.uint8))).astype(int)
                  - (200, 40, 20)).max() < 6
    grey = np.arange(24, dtype=np.uint8).reshape(4, 6)
    assert (from_compressed("mono8; png compressed", encoded(".png", grey)) == grey).all()
    mosaic = np.tile(np.array([[250, 120], [120, 20]], np.uint8), (8, 8))
    assert (from_compressed("bayer_rggb8; png compressed", encoded(".png", mosaic))[4:12, 4:12] == (250, 120, 20)).all()


def test_depth_sent_by_the_transport_for_colours():
    assert from_compressed("16UC1; png compressed", encoded(".png", np.array([[0, 5000]], np.uint16))).tolist() == [[0, 127]]


def test_compressed_depth():
    head = struct.pack("<iff", 0, 100.0, 1.0)
    millimetres = np.array([[0, 5000]], np.uint16)
    assert from_compressed("16UC1; compressedDepth", head + encoded(".png", millimetres)).tolist() == [[0, 127]]
    metres = np.array([[2.5, 5.0]], np.float32)
    inverse = np.hstack((100.0 / metres + 1.0, [[0.0]])).astype(np.uint16)
    picture = from_compressed("32FC1; compressedDepth png", head + encoded(".png", inverse))
    assert picture.shape == (1, 3) and abs(int(picture[0, 0]) - 63) < 2 and abs(int(picture[0, 1]) - 127) < 3 and picture[0, 2] == 0


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
        for value in values[zeros:zeros + others]:
            put((value - previous) << 1 if value >= previous else ((previous - value) << 1) - 1)
            previous = value
        values = values[zeros + others:]
    nibbles += [0] * (-len(nibbles) % 8)
    words = [sum(nibble << 4 * (7 - i) for i, nibble in enumerate(nibbles[n:n + 8])) for n in range(0, len(nibbles), 8)]
    return struct.pack(f"<II{len(words)}I", pixels.shape[1], pixels.shape[0], *words)


def test_depth_compressed_with_rvl():
    assert decode_rvl(RVL).tolist() == [[0, 0, 5, 6, 0]]
    noise = np.random.default_rng(3)
    depth = np.where(noise.random((48, 64)) < 0.3, 0, noise.integers(0, 65536, (48, 64))).astype(np.uint16)
    assert np.array_equal(decode_rvl(rvl(depth)), depth)
    metres = np.array([[0, 5000, 10000]], np.uint16)
    picture = from_compressed("16UC1; compressedDepth rvl", bytes(12) + rvl(metres))
    assert picture.tolist() == [[0, 127, 255]]


@pytest.mark.parametrize("layout, data, said", [
    ("jpeg", b"", "0 bytes of 'jpeg' cannot be decoded"), ("png", b"\x89PNG\r\n\x1a\nrubbish", "cannot be decoded"),
    ("16UC1; compressedDepth", b"short", "lacks its 12 bytes"), ("16UC1; compressedDepth", bytes(40), "cannot be decoded"),
    ("16UC1; compressedDepth rvl", bytes(40), "0x0 pixels"), ("16UC1; compressedDepth rvl", bytes(12) + RVL[:8], "cut short"),
    ("16UC1; compressedDepth rvl", bytes(12) + RVL[:8] + b"\xff" * 40, "cut short"),
    ("16UC1; compressedDepth rvl", bytes(12) + struct.pack("<II", 3, 1) + RVL[8:], "no depth image of 3x1")])
def test_broken_compressed_images_are_told(layout, data, said):
    with pytest.raises(PictureError, match=said):
        from_compressed(layout, data)


def test_theora():
    scene = np.zeros((45, 61, 3), np.uint8)
    scene[:], scene[10:30, 10:40] = (20, 80, 160), (240, 40, 30)
    encoder, decoder = Encoder(scene.shape[:2], "rgb8"), TheoraDecoder()
    data = [packet.data for i in range(3) for packet in encoder.encode(np.roll(scene, i, axis=1).tobytes())]
    assert decoder.decode(data[0]) is None  # in the middle of a stream: no heads yet
    for head in encoder.headers:
        assert decoder.decode(head.data) is None
    pictures = [decoder.decode(packet) for packet in data]
    assert all(picture.shape == scene.shape for picture in pictures)
    assert np.abs(pictures[-1].astype(int) - scene)[15:25, 15:35].max() < 16
    with pytest.raises(PictureError, match="cannot be decoded"):
        TheoraDecoder.decode(decoder, b"\x3f" + bytes(3))
        decoder.decode(b"\x2aabc")


@pytest.mark.parametrize("quarters", [0, 1, 2, 3])
def test_a_click_names_the_pixel_before_the_rotation(quarters):
    picture = np.arange(24, dtype=np.uint8).reshape(4, 6)
    turned = rotated(picture, quarters)
    for row in range(turned.shape[0]):
        for column in range(turned.shape[1]):
            x, y = unrotated_point(column, row, 4, 6, quarters)
            assert picture[y, x] == turned[row, column]


def test_rotation_is_clockwise():
    assert rotated(np.array([[1, 2], [3, 4]], np.uint8), 1).tolist() == [[3, 1], [4, 2]]


def test_grid_lines_are_symmetric_and_inverted():
    grid = invert_grid(np.zeros((9, 21, 3), np.uint8), 2)
    assert (grid[3] == 255).all() and (grid[6] == 255).all() and (grid[:, 7] == 255).all() and (grid[:, 14] == 255).all()
    assert (grid[0, :7] == 0).all()
