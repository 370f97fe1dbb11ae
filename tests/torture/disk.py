"""A disk that may lose its power: writes and syncs as ``strace`` saw them, replayed up to a cut.

What was not synced is lost, kept or torn at sectors, each write by itself; names that were made,
moved or removed since the folder was last synced are undone from the newest backwards.
"""

from __future__ import annotations

import os
import random
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

SECTOR = 512
CALLS = (
    "openat,close,pwrite64,write,writev,lseek,ftruncate,fsync,fdatasync,"
    "unlink,unlinkat,rename,renameat,renameat2,link,linkat"
)


@dataclass(frozen=True)
class Event:
    """One thing that happened to the disk, or an acknowledgement on stdout."""

    kind: str
    inode: int = -1
    name: str = ""
    offset: int = 0
    data: bytes = b""


@dataclass
class _Inode:
    volatile: bytearray = field(default_factory=bytearray)
    durable: bytes = b""
    pending: list[Event] = field(default_factory=list)


@dataclass
class Disk:
    """A folder's names and contents: as a running system sees them, and as the disk has them."""

    inodes: dict[int, _Inode] = field(default_factory=dict)
    names: dict[str, int] = field(default_factory=dict)
    durable_names: dict[str, int] = field(default_factory=dict)
    pending: list[dict[str, int]] = field(default_factory=list)
    acknowledged: int = 0

    @classmethod
    def of(cls, folder: Path) -> Disk:
        """A folder that lies on the disk already; its files are the inodes -2, -3, ..."""
        disk = cls()
        for place, path in enumerate(sorted(folder.iterdir())):
            data = path.read_bytes()
            disk.inodes[-2 - place] = _Inode(bytearray(data), data)
            disk.names[path.name] = -2 - place
        disk.durable_names = dict(disk.names)
        return disk

    def happen(self, event: Event) -> None:
        """Let one event happen."""
        if event.kind == "ack":
            self.acknowledged += 1
        elif event.kind == "sync folder":
            self.durable_names, self.pending = dict(self.names), []
        elif event.kind in ("name", "unname"):
            names = dict(self.names)
            if event.kind == "name":
                names[event.name] = event.inode
            else:
                names.pop(event.name, None)
            self.names = names
            self.pending.append(names)
            self.inodes.setdefault(event.inode, _Inode())
        elif event.kind == "sync":
            inode = self.inodes[event.inode]
            inode.durable, inode.pending = bytes(inode.volatile), []
        else:
            inode = self.inodes[event.inode]
            inode.pending.append(event)
            _apply(inode.volatile, event)

    def cut(self, folder: Path, generator: random.Random) -> None:
        """Write to ``folder`` what a power cut at this moment may leave."""
        versions = [self.durable_names, *self.pending]
        for name, number in generator.choice(versions).items():
            inode = self.inodes[number]
            data = bytearray(inode.durable)
            for event in inode.pending:
                fate = generator.choice(("lost", "kept", "torn"))
                if fate == "torn":
                    _tear(data, event, generator)
                elif fate == "kept":
                    _apply(data, event)
            (folder / name).write_bytes(data)


def _apply(data: bytearray, event: Event) -> None:
    if event.kind == "truncate":
        del data[event.offset :]
        data.extend(bytes(event.offset - len(data)))
        return
    data.extend(bytes(max(0, event.offset - len(data))))
    data[event.offset : event.offset + len(event.data)] = event.data


def _tear(data: bytearray, event: Event, generator: random.Random) -> None:
    """Some of a write's sectors."""
    if event.kind == "truncate":
        return
    for at in range(0, len(event.data), SECTOR):
        if generator.random() < 0.5:
            part = event.data[at : at + SECTOR]
            _apply(data, Event("write", event.inode, offset=event.offset + at, data=part))


# ------------------------------------------------------------------ reading strace's words


_LINE = re.compile(r"^(?:\d+ +)?(\w+)\((.*)\) += (-?\d+)")
_TEXT = re.compile(r'"((?:\\x[0-9a-f]{2})*)"')


@dataclass
class _Handle:
    """An open file of the folder, or the folder itself (inode -1)."""

    inode: int
    at: int = 0


def events(log: Path, folder: Path) -> Iterator[Event]:
    """What a process did to ``folder``, from ``strace -xx -s BIG -o log -e trace=CALLS``."""
    reader = _Reader(folder)
    with log.open(encoding="ascii", errors="replace") as lines:
        for line in lines:
            match = _LINE.match(line)
            if match and int(match[3]) >= 0:
                yield from reader.event(match[1], match[2], int(match[3]))


class _Reader:
    def __init__(self, folder: Path) -> None:
        self.folder = os.path.realpath(folder)
        self.handles: dict[int, _Handle] = {}
        disk = Disk.of(folder)
        self.names, self.next_inode = dict(disk.names), 1

    def event(self, call: str, words: str, result: int) -> Iterator[Event]:
        texts = [bytes.fromhex(text.replace("\\x", "")) for text in _TEXT.findall(words)]
        plain = _TEXT.sub("", words)
        if call == "openat":
            yield from self._open(texts[0], plain, result)
        elif call.startswith("unlink"):
            yield from self._unname(texts[0])
        elif call.startswith(("rename", "link")):
            yield from self._renamed(texts[0], texts[1], moved=call.startswith("rename"))
        else:
            yield from self._on_handle(call, texts, plain, result)

    def _inside(self, raw: bytes) -> str | None:
        path = os.fsdecode(raw)
        head, _, name = path.rpartition("/")
        return name if head == self.folder else None

    def _open(self, raw: bytes, plain: str, handle: int) -> Iterator[Event]:
        self.handles.pop(handle, None)
        name = self._inside(raw)
        if os.fsdecode(raw).rstrip("/") == self.folder:
            self.handles[handle] = _Handle(-1)
        if name is None:
            return
        if name not in self.names:
            self.names[name] = self.next_inode
            self.next_inode += 1
            yield Event("name", self.names[name], name)
        elif "O_TRUNC" in plain:
            yield Event("truncate", self.names[name])
        self.handles[handle] = _Handle(self.names[name])

    def _unname(self, raw: bytes) -> Iterator[Event]:
        name = self._inside(raw)
        if name is not None:
            yield Event("unname", self.names.pop(name), name)

    def _renamed(self, old: bytes, new: bytes, *, moved: bool) -> Iterator[Event]:
        before, after = self._inside(old), self._inside(new)
        if before is None or after is None:
            return
        self.names[after] = self.names[before]
        yield Event("name", self.names[after], after)
        if moved:
            yield Event("unname", self.names.pop(before), before)

    def _on_handle(self, call: str, texts: list[bytes], plain: str, result: int) -> Iterator[Event]:
        numbers = [int(number) for number in re.findall(r"(?<![\w.])-?\d+", plain)]
        handle = self.handles.get(numbers[0])
        if call == "close":
            self.handles.pop(numbers[0], None)
        elif call == "writev" and texts == [b"."]:
            yield Event("ack")
        elif handle is None:
            return
        elif call in ("fsync", "fdatasync"):
            yield Event("sync folder" if handle.inode == -1 else "sync", handle.inode)
        elif call == "ftruncate":
            yield Event("truncate", handle.inode, offset=numbers[1])
        elif call == "lseek":
            handle.at = result
        elif call == "pwrite64":
            yield Event("write", handle.inode, offset=numbers[-1], data=texts[0][:result])
        elif call == "write":
            yield Event("write", handle.inode, offset=handle.at, data=texts[0][:result])
            handle.at += result
