"""Depth to what is seen, theora, and what the window does with pictures. Encodings: image_pixels."""

import struct

import cv2
import numpy as np
import pytest
from rqt_image_view.pictures import (
    COLOR_SCHEMES,
    DepthView,
    PictureError,
    TheoraDecoder,
    from_compressed,
    from_raw,
    invert_grid,
    rotated,
    show_depth,
    unrotated_point,
)
from theora_image_transport.encoder import Encoder


def raw(pixels, encoding, **more):
    pixels = np.ascontiguousarray(pixels)
    return from_raw(encoding, pixels.shape[0], pixels.shape[1], pixels.strides[0], pixels.tobytes(), **more)


def test_depth_in_metres_and_millimetres():
    metres = np.array([[0.0, 2.5, 5.0], [10.0, np.nan, np.inf]], np.float32)
    assert raw(metres, "32FC1").tolist() == [[0, 63, 127], [255, 0, 255]]
    millimetres = np.array([[0, 2500, 5000], [10_000, 60_000, 1]], np.uint16)
    assert raw(millimetres, "16UC1").tolist() == [[0, 63, 127], [255, 255, 0]]
    assert raw(metres, "32FC1", depth=DepthView(max_depth=5.0)).tolist() == [[0, 127, 255], [255, 0, 255]]
    assert raw(metres[:, :2], "32FC1", depth=DepthView(dynamic=True)).tolist() == [[0, 63], [255, 0]]


def test_depth_in_colours():
    assert list(COLOR_SCHEMES) == "Autumn Bone Cool Gray Hot Hsv Jet Ocean Pink Rainbow Spring Summer Winter".split()
    picture = show_depth(np.array([[np.nan, 1.0, 9.0]], np.float32), 1.0, DepthView(scheme="Jet"))
    assert picture.shape == (1, 3, 3) and picture[0, 0].tolist() == [0, 0, 0]
    assert picture[0, 1].argmax() == 2 and picture[0, 2].argmax() == 0  # near blue, far red


def test_depth_of_nothing():
    assert show_depth(np.full((2, 2), np.nan, np.float32), 1.0, DepthView(dynamic=True)).tolist() == [[0, 0], [0, 0]]
    assert show_depth(np.zeros((2, 2), np.uint16), 1e-3, DepthView(dynamic=True)).max() == 0


def encoded(kind, pixels):
    return cv2.imencode(kind, pixels)[1].tobytes()


def test_compressed_depth_is_shown_as_depth():
    data = struct.pack("<iff", 0, 100.0, 1.0) + encoded(".png", np.array([[0, 5000]], np.uint16))
    assert from_compressed("16UC1; compressedDepth", data).tolist() == [[0, 127]]


@pytest.mark.parametrize("read", [lambda: from_raw("rgb9", 1, 1, 3, b"123"), lambda: from_compressed("jpeg", b"")])
def test_what_is_no_picture_is_an_error_of_the_window(read):
    with pytest.raises(PictureError) as error:
        read()
    assert "\n" not in str(error.value)


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
