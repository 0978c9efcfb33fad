"""What scripts/truth does for each of its words."""

from __future__ import annotations

import os

from real_gazebo import chroot
from real_gazebo.records import Record, path_of
from real_gazebo.scene import Scene
from real_gazebo.scenes import SCENES


def chosen(names: list[str]) -> list[Scene]:
    """Scenes of these names, families or beginnings of names; all where there are none."""
    if not names:
        return list(SCENES)
    found = [scene for scene in SCENES if any(scene.name.startswith(n) or scene.family == n for n in names)]
    if not found:
        raise chroot.ChrootError(f"no scene is called {' or '.join(names)}; scripts/truth list names them")
    return found


def has_record(scene: Scene) -> bool:
    return os.path.exists(path_of(scene.name)) and Record.read(path_of(scene.name)).digest == scene.digest()


def main(words: list[str], usage: str) -> int:
    word, names = (words or ["--help"])[0], words[1:]
    try:
        if word == "list":
            for scene in chosen(names):
                print(f"{scene.family:10} {scene.name:32} {'' if has_record(scene) else '(no record) '}{scene.what}")
        elif word == "chroot":
            chroot.make(chroot.default_folder())
        elif word == "record":
            folder = chroot.default_folder()
            if not chroot.installed(folder):
                raise chroot.ChrootError(f"there is no real Gazebo in {folder}: run scripts/truth chroot first")
            chroot.build_recorder(folder)
            scenes = chosen(names) if names else [s for s in SCENES if not has_record(s)]
            failed = chroot.record_all(scenes, folder, lambda line: print(line, flush=True))
            return 1 if failed else 0
        elif word == "compare":
            from real_gazebo.compare import compare, told

            for scene in chosen(names):
                for result in compare(scene):
                    print(told(scene, result), flush=True)
        elif word == "page":
            from real_gazebo.page import write

            print(write())
        else:
            print(usage.strip())
            return 0 if word in ("-h", "--help") else 2
    except chroot.ChrootError as error:
        print(f"truth: {error}")
        return 1
    return 0
