"""What programs of a submission may not ask of the kernel: a filter for bubblewrap, which the kernel runs at each system call (seccomp).

What is refused here holds memory that no limit counts (segments of System V, keys), or opens parts of the kernel that nothing of ROS needs
and in which most of its escapes were found.
"""

from __future__ import annotations

import platform
import struct

# Names for whoever reads this; numbers of x86-64 and of arm64, from the kernel's tables (syscall_64.tbl, asm-generic/unistd.h).
_REFUSED = {
    "shmget": (29, 194),
    "msgget": (68, 186),
    "semget": (64, 190),
    "add_key": (248, 217),
    "request_key": (249, 218),
    "keyctl": (250, 219),
    "perf_event_open": (298, 241),
    "bpf": (321, 280),
    "userfaultfd": (323, 282),
    "io_uring_setup": (425, 425),
    "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427),
    "fanotify_init": (300, 262),
    "kexec_load": (246, 104),
    "mount": (165, 40),
    "umount2": (166, 39),
    "pivot_root": (155, 41),
    "open_by_handle_at": (304, 265),
    "memfd_secret": (447, 447),
    "vmsplice": (278, 75),
    "mq_open": (240, 180),
    "fsopen": (430, 430),
    "move_mount": (429, 429),
    "open_tree": (428, 428),
    "quotactl": (179, 60),
    "swapon": (167, 224),
}
_MACHINES = {"x86_64": (0xC000003E, 0), "aarch64": (0xC00000B7, 1)}  # AUDIT_ARCH_..., column of _REFUSED
_LOAD, _EQUAL, _AT_LEAST, _RETURN = 0x20, 0x15, 0x35, 0x06
_ALLOW, _REFUSE, _KILL = 0x7FFF0000, 0x00050000 | 1, 0x80000000  # EPERM
_X32 = 0x40000000  # numbers of a second table on x86-64


def program() -> bytes:
    """The filter in the kernel's form (struct sock_filter); b'' for a machine whose numbers are not here."""
    if platform.machine() not in _MACHINES:
        return b""
    architecture, column = _MACHINES[platform.machine()]
    numbers = sorted(entry[column] for entry in _REFUSED.values())
    lines = [(_LOAD, 0, 0, 4), (_EQUAL, 1, 0, architecture), (_RETURN, 0, 0, _KILL), (_LOAD, 0, 0, 0)]
    lines += [(_AT_LEAST, len(numbers) + 1, 0, _X32)]
    lines += [(_EQUAL, len(numbers) - index, 0, number) for index, number in enumerate(numbers)]
    lines += [(_RETURN, 0, 0, _ALLOW), (_RETURN, 0, 0, _REFUSE)]
    return b"".join(struct.pack("HBBI", *line) for line in lines)
