"""Pictures of the documentation, each by its name: what is run, clicked and kept."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from picturing import pages, tutorial, windows
from picturing.common import ROOT, Options, Trouble

#: name -> (what it shows, who makes it)
NAMES: dict[str, tuple[str | None, Callable[[str, Options], Path]]] = {
    **{name: (act.__doc__, pages.make) for name, (_, act) in pages.PAGES.items()},
    "pick": (pages.film.__doc__, pages.film),
    **{name: (act.__doc__, windows.make) for name, (*_, act) in windows.WINDOWS.items()},
    **{name: (act.__doc__, tutorial.make) for name, act in tutorial.CHAPTERS.items()},
}
FROM_OUTSIDE = ("gzclient_house",)


def main() -> int:
    listed = "\n".join(f"  {name:20} {text}" for name, (text, _) in NAMES.items())
    parser = argparse.ArgumentParser(
        prog="scripts/pictures", description=f"{__doc__}\n\n{listed}", formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all that need nothing from outside")
    parser.add_argument("--house", type=Path, help=f"folder of {pages.HOUSE}")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "pictures", help="folder (default docs/pictures)")
    chosen = parser.parse_args()
    unknown = [name for name in chosen.names if name not in NAMES]
    if unknown:
        print(f"scripts/pictures: there is no picture {unknown[0]}; there are {', '.join(NAMES)}", file=sys.stderr)
        return 2
    chosen.out.mkdir(parents=True, exist_ok=True)
    options = Options(chosen.out, chosen.house)
    for name in chosen.names or [name for name in NAMES if name not in FROM_OUTSIDE or chosen.house]:
        try:
            print(NAMES[name][1](name, options))
        except (Trouble, AssertionError) as error:
            print(f"scripts/pictures: {name}: {error}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
