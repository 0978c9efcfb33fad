"""Bags and MCAP files as streams of (channel, time, bytes). The bytes of a message are never decoded.

A channel is one publisher of one topic, as a connection is in a bag. In MCAP it is what the format's registry calls the ros1 profile:
messages ``ros1``, schemas ``ros1msg``, and ``callerid``, ``latching`` and ``md5sum`` as metadata of the channel
(https://mcap.dev/spec/registry).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mcap.reader import make_reader
from mcap.writer import CompressionType
from mcap.writer import Writer as McapFile
from rosbags.rosbag1 import Reader, ReaderError
from rosbags.rosbag1 import Writer as BagFile

Message = tuple["Channel", int, bytes]  # channel, ns since the epoch (when it was received), serialized message
MCAP_COMPRESSIONS = {"none": CompressionType.NONE, "lz4": CompressionType.LZ4, "zstd": CompressionType.ZSTD}
BAG_COMPRESSIONS = {"none": None, "bz2": BagFile.CompressionFormat.BZ2}  # roslz4 does not read the frames of python3-lz4


class BagError(Exception):
    """A file that cannot be read or written, in one line."""


@dataclass(frozen=True)
class Channel:
    number: int  # tells apart publishers of one topic that are the same otherwise
    topic: str
    type: str  # package/Type
    md5sum: str
    definition: str  # with those of all types that it uses, as gendeps --cat prints them
    callerid: str | None
    latching: bool


class BagSource:
    """A bag of ROS 1, format 2.0. A context manager.

    :raises BagError: no bag, encrypted, without an index, damaged
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._bag = Reader(path)
            self._bag.open()
        except ReaderError as error:
            raise BagError(_of_bag(path, error)) from None
        except (ValueError, KeyError, AssertionError, UnicodeDecodeError, EOFError) as error:
            raise BagError(f"{path} is damaged: {type(error).__name__}; 'rosbag check {path}' tells more") from None

    def __enter__(self) -> BagSource:
        return self

    def __exit__(self, *_: object) -> None:
        self._bag.close()

    @property
    def count(self) -> int:
        return self._bag.message_count

    def __iter__(self) -> Iterator[Message]:
        """In the order of the times.

        :raises BagError: damaged
        """
        channels: dict[int, Channel] = {}
        try:
            for connection, stamp, data in self._bag.messages():
                if connection.id not in channels:
                    extra: Any = connection.ext
                    channels[connection.id] = Channel(
                        connection.id,
                        connection.topic,
                        _ros1_name(connection.msgtype),
                        connection.digest,
                        connection.msgdef.data,
                        extra.callerid,
                        bool(extra.latching),
                    )
                yield channels[connection.id], stamp, bytes(data)
        except (ReaderError, OSError, ValueError, EOFError, RuntimeError) as error:
            raise BagError(f"{self.path} is damaged: {_line(error)}; 'rosbag reindex' may save what is before that") from None


class McapSource:
    """An MCAP file of ROS 1 messages. A context manager.

    :raises BagError: no MCAP, cut off, or of other messages
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file = open(path, "rb")
        try:
            self._reader = make_reader(self._file)
            self._summary = self._reader.get_summary()
        except Exception as error:  # the reader lets through whatever damaged bytes lead to
            self._file.close()
            raise BagError(f"{path} is no MCAP file, or cut off or damaged: {_line(error)}") from None
        for channel in self._summary.channels.values() if self._summary else ():
            if channel.message_encoding != "ros1":
                self._file.close()
                raise BagError(
                    f"{path}: {channel.topic} holds {channel.message_encoding or 'unnamed'} messages, not those of ROS 1; of "
                    "a bag of ROS 2 give the folder with its metadata.yaml"
                )

    def __enter__(self) -> McapSource:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    @property
    def count(self) -> int | None:
        """None where the file does not say."""
        return self._summary.statistics.message_count if self._summary and self._summary.statistics else None

    def __iter__(self) -> Iterator[Message]:
        """In the order of the times.

        :raises BagError: damaged, or a message without definition
        """
        channels: dict[int, Channel] = {}
        try:
            for schema, channel, message in self._reader.iter_messages():
                if channel.id not in channels:
                    channels[channel.id] = self._channel(schema, channel)
                yield channels[channel.id], message.log_time, message.data
        except BagError:
            raise
        except Exception as error:  # as above
            raise BagError(f"{self.path} is cut off or damaged: {_line(error)}") from None

    def _channel(self, schema: Any, channel: Any) -> Channel:
        if channel.message_encoding != "ros1" or schema is None or schema.encoding != "ros1msg":
            raise BagError(f"{self.path}: {channel.topic} has no definition of a ROS 1 message (schema encoding ros1msg)")
        definition = schema.data.decode("utf-8", "replace")
        md5sum = channel.metadata.get("md5sum") or _md5sum(schema.name, definition)
        return Channel(
            channel.id,
            channel.topic,
            schema.name,
            md5sum,
            definition,
            channel.metadata.get("callerid"),
            channel.metadata.get("latching", "").lower() in ("true", "1"),
        )


class BagSink:
    """Writes a bag. ``compression``: none or bz2. A context manager.

    :raises BagError: it exists
    """

    def __init__(self, path: Path, compression: str = "none") -> None:
        self._bag = BagFile(path)
        chosen = BAG_COMPRESSIONS[compression]
        if chosen is not None:
            self._bag.set_compression(chosen)
        self._bag.open()
        self._connections: dict[Channel, Any] = {}

    def __enter__(self) -> BagSink:
        return self

    def __exit__(self, *_: object) -> None:
        self._bag.close()

    def write(self, channel: Channel, stamp: int, data: bytes) -> None:
        """Append ``data``, a message as bytes, of ``channel``; ``stamp``: ns since the epoch."""
        if channel not in self._connections:
            self._connections[channel] = self._bag.add_connection(
                channel.topic,
                _ros2_name(channel.type),
                msgdef=channel.definition,
                md5sum=channel.md5sum,
                callerid=channel.callerid,
                latching=1 if channel.latching else None,
            )
        self._bag.write(self._connections[channel], stamp, data)


class McapSink:
    """Writes an MCAP file. ``compression``: none, lz4 or zstd. A context manager."""

    def __init__(self, path: Path, compression: str = "zstd") -> None:
        self._stream = open(path, "wb")
        self._file = McapFile(self._stream, compression=MCAP_COMPRESSIONS[compression])
        self._file.start(profile="ros1", library="noetic_labs bag_tools")
        self._schemas: dict[tuple[str, str], int] = {}
        self._channels: dict[Channel, int] = {}
        self._sequences: dict[int, int] = {}

    def __enter__(self) -> McapSink:
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self._file.finish()
        finally:
            self._stream.close()

    def write(self, channel: Channel, stamp: int, data: bytes) -> None:
        """Append ``data``, a message as bytes, of ``channel``; ``stamp``: ns since the epoch."""
        if channel not in self._channels:
            self._channels[channel] = self._register(channel)
        number = self._channels[channel]
        sequence = self._sequences[number] = self._sequences.get(number, -1) + 1
        self._file.add_message(number, log_time=stamp, data=data, publish_time=stamp, sequence=sequence)

    def _register(self, channel: Channel) -> int:
        key = (channel.type, channel.definition)
        if key not in self._schemas:
            self._schemas[key] = self._file.register_schema(channel.type, "ros1msg", channel.definition.encode())
        metadata = {"md5sum": channel.md5sum, "latching": "true" if channel.latching else "false"}
        if channel.callerid is not None:
            metadata["callerid"] = channel.callerid
        return self._file.register_channel(channel.topic, "ros1", self._schemas[key], metadata)


def _ros1_name(name: str) -> str:
    return name.replace("/msg/", "/", 1)


def _ros2_name(name: str) -> str:
    package, _, message = name.partition("/")
    return f"{package}/msg/{message}"


def _md5sum(name: str, definition: str) -> str:
    """Where a file has none. :raises BagError: not a definition of ROS 1"""
    from genpy.dynamic import generate_dynamic

    try:
        return str(generate_dynamic(name, definition)[name]._md5sum)
    except Exception as error:  # genpy has many
        raise BagError(f"the definition of {name} cannot be read: {_line(error)}") from None


def _of_bag(path: Path, error: Exception) -> str:
    text = _line(error)
    if "index" in text.lower():
        return f"{path} has no index, as after a crash: run 'rosbag reindex {path}'"
    return f"{path} is no bag that can be read: {text}"


def _line(error: BaseException) -> str:
    return " ".join(str(error).split())[:200] or type(error).__name__


__all__ = ["BAG_COMPRESSIONS", "MCAP_COMPRESSIONS", "BagError", "BagSink", "BagSource", "Channel", "McapSink", "McapSource"]
