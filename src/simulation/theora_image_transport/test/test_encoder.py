"""Packets as a receiver sees them: headers by the Theora specification, pictures by ffmpeg's own decoder."""

import av
import numpy as np
import pytest
from theora_image_transport.encoder import Encoder, Settings, available
from theora_image_transport.msg import Packet

SHAPE = (123, 162)  # neither is whole blocks, one is odd


def scene(step=0):
    """(123, 162, 3) uint8 RGB: ramps and a box that moves."""
    rows, columns = np.indices(SHAPE)
    picture = np.stack([columns, rows, 255 - columns], axis=2).astype(np.uint8)
    picture[40:80, 20 + 4 * step : 60 + 4 * step] = (250, 30, 30)
    return picture


def decode(headers, packets):
    """(n, height, width, 3) RGB: what a subscriber of theora_image_transport makes of it, Y 0..255."""
    context = av.CodecContext.create("theora", "r")
    context.extradata = b"".join(len(h.data).to_bytes(2, "big") + h.data for h in headers)
    frames = [frame for packet in packets for frame in context.decode(av.Packet(packet.data))] + context.decode(None)
    return np.stack([rgb(frame) for frame in frames])


def rgb(frame):
    """By hand: PyAV makes no arrays of 4:2:0 frames of odd size."""
    y, u, v = (np.frombuffer(p, np.uint8).reshape(-1, p.line_size)[:, : p.width].astype(float) for p in frame.planes)
    u, v = (np.kron(p, np.ones((2, 2)))[: frame.height, : frame.width] - 128 for p in (u, v))
    y = y[: frame.height]
    return np.clip(np.stack([y + 1.402 * v, y - 0.344 * u - 0.714 * v, y + 1.772 * u], axis=2), 0, 255)


def test_message_is_the_one_of_theora_image_transport():
    assert available()
    assert Packet._md5sum == "33ac4e14a7cff32e7e0d65f18bb410f3"


def test_headers():
    headers = Encoder(SHAPE, "rgb8").headers
    assert [h.data[:7] for h in headers] == [b"\x80theora", b"\x81theora", b"\x82theora"]
    assert [(h.b_o_s, h.granulepos, h.packetno) for h in headers] == [(1, 0, 0), (0, 0, 1), (0, 0, 2)]
    info = headers[0].data
    sizes = [int.from_bytes(info[a:b], "big") for a, b in ((10, 12), (12, 14), (14, 17), (17, 20), (20, 21), (21, 22))]
    assert sizes == [11, 8, 162, 123, 0, 128 - 123]


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "mono8"])
def test_pictures_come_back(encoding):
    encoder = Encoder(SHAPE, encoding, Settings(quality=60))
    pictures = [scene(i) for i in range(6)]
    sent = [{"rgb8": p, "bgr8": p[..., ::-1], "mono8": p[..., 0]}[encoding].tobytes() for p in pictures]
    got = decode(encoder.headers, [packet for data in sent for packet in encoder.encode(data)])
    expected = np.stack(pictures) if encoding != "mono8" else np.stack([p[..., :1].repeat(3, axis=2) for p in pictures])
    assert got.shape == expected.shape
    assert np.abs(got.astype(float) - expected).mean() < 3
    assert np.abs(got[:, 55:65, 42:58].astype(float) - expected[:, 55:65, 42:58]).max() < 12  # full range kept


def test_granulepos_counts_from_the_key_frame():
    encoder = Encoder(SHAPE, "rgb8", Settings(keyframe_frequency=4))
    info = encoder.headers[0].data
    shift = (int.from_bytes(info[40:42], "big") >> 5) & 31
    packets = [packet for i in range(10) for packet in encoder.encode(scene(i).tobytes())]
    keys = [i for i, packet in enumerate(packets) if not packet.data[0] & 0x40]
    assert keys[0] == 0 and len(keys) > 2 and max(np.diff(keys)) <= 4 and len(keys) < 10
    for i, packet in enumerate(packets):
        key = max(k for k in keys if k <= i)
        assert packet.granulepos >> shift == key + 1
        assert packet.granulepos & ((1 << shift) - 1) == i - key
    assert [packet.packetno for packet in packets] == list(range(3, 13))


def test_quality_is_in_the_header_and_makes_streams_larger():
    sizes = []
    for quality in (0, 31, 63):
        encoder = Encoder(SHAPE, "rgb8", Settings(quality=quality))
        assert encoder.headers[0].data[40] >> 2 == quality
        sizes.append(len(encoder.encode(scene().tobytes())[0].data))
    assert sizes == sorted(set(sizes))


def test_bitrate_is_aimed_at():
    noise = np.random.default_rng(1)

    def total(bitrate):
        encoder = Encoder(SHAPE, "rgb8", Settings(bitrate=bitrate))
        assert int.from_bytes(encoder.headers[0].data[37:40], "big") == bitrate
        return sum(
            len(packet.data) for i in range(30) for packet in encoder.encode(noise.integers(0, 255, (*SHAPE, 3), np.uint8).tobytes())
        )

    assert total(200_000) < total(2_000_000) / 2


def test_two_encoders_give_the_same_bytes():
    runs = [
        [packet for i in range(5) for packet in encoder.encode(scene(i).tobytes())]
        for encoder in (Encoder(SHAPE, "rgb8"), Encoder(SHAPE, "rgb8"))
    ]
    assert runs[0] == runs[1]
