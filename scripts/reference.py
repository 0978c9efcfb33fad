"""scripts/reference [PACKAGE...]: the API reference, from the docstrings, as pages in out/reference. Needs scripts/setup.

PACKAGE is a Python package of the workspace; without any, those that people write controllers, plugins, checks and programs with.
"""

import html
import importlib
import inspect
import pkgutil
import pydoc
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "out" / "reference"
PACKAGES = (
    "ode_sim",
    "ode_sim_rendering",
    "ode_sim_viewer",
    "ode_sim_gym",
    "motion",
    "building_editor",
    "gazebo_ros",
    "gazebo_plugins",
    "gazebo_ros_control",
    "controller_interface",
    "controller_manager",
    "hardware_interface",
    "joint_limits_interface",
    "transmission_interface",
    "control_toolbox",
    "realtime_tools",
    "urdf_geometry_parser",
    "forward_command_controller",
    "diff_drive_controller",
    "joint_trajectory_controller",
    "moveit_commander",
    "lab_check",
    "plugin_loader",
    "dynamic_parameters",
    "image_pixels",
    "lenient_xml",
    "node_signals",
    "test_support",
)
_HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body {{ font: 15px/1.45 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222 }}
pre {{ background: #f4f4f2; padding: .6em .8em; white-space: pre-wrap }}
code, .signature {{ font-family: monospace }} .member {{ margin: 0 0 1em 2em }} h3 {{ margin-bottom: .2em }}
</style></head><body>
"""


def modules_of(package):
    """Names of the package and its public modules, those that cannot be imported here with the reason."""
    found, left_out = [package], []
    for entry in pkgutil.walk_packages(importlib.import_module(package).__path__, package + "."):
        if any(part.startswith("_") for part in entry.name.split(".")):
            continue
        try:
            importlib.import_module(entry.name)
            found.append(entry.name)
        except Exception as error:  # a module may want a display, or hardware
            left_out.append((entry.name, " ".join(str(error).split())[:200]))
    return found, left_out


def signature(thing):
    try:
        text = re.sub(r" at 0x[0-9a-f]+", "", str(inspect.signature(thing)))
        return re.sub(r"'([^']*)'", r"\1", re.sub(r"^\((self|cls)(, )?", "(", text)).replace('"', "")
    except (TypeError, ValueError):  # compiled code says it in the first line of its docstring
        return "(...)"


def doc(thing):
    text = pydoc.getdoc(thing)
    return f"<pre>{html.escape(text)}</pre>\n" if text else ""


def own(thing, module):
    """What the module itself defines, or offers by __all__."""
    listed = getattr(module, "__all__", None)
    for name, value in sorted(vars(module).items()):
        if name in listed if listed is not None else not name.startswith("_") and getattr(value, "__module__", "") == module.__name__:
            if thing(value):
                yield name, value


def member(name, value):
    """A method, property or function: signature and docstring; '' where it has no docstring."""
    value = value.__func__ if isinstance(value, (classmethod, staticmethod)) else value
    text = doc(value)
    if not text:
        return ""
    shown = name if isinstance(value, property) or inspect.isdatadescriptor(value) else name + signature(value)
    return f'<div class="member"><span class="signature">{html.escape(shown)}</span>\n{text}</div>\n'


def class_page(name, kind):
    bases = ", ".join(base.__name__ for base in kind.__bases__ if base is not object)
    members = (member(key, value) for key, value in vars(kind).items() if not key.startswith("_"))
    return f'<h3 id="{name}">class {html.escape(name)}{f"({bases})" if bases else ""}</h3>\n{doc(kind)}{"".join(members)}'


def module_page(name):
    module = importlib.import_module(name)
    classes = [class_page(*entry) for entry in own(inspect.isclass, module)]
    functions = [member(*entry) for entry in own(inspect.isroutine, module)]
    return (
        _HEAD.format(title=name)
        + f'<p><a href="index.html">all modules</a></p>\n<h1>{name}</h1>\n{doc(module)}'
        + "".join(classes)
        + ("<h2>functions</h2>\n" if any(functions) else "")
        + "".join(functions)
        + "</body></html>\n"
    )


def write(packages, out):
    """Pages of the packages and their index. :return: lines about what is not in it"""
    out.mkdir(parents=True, exist_ok=True)
    for page in out.glob("*.html"):
        page.unlink()
    rows, missing = [], []
    for package in packages:
        try:
            modules, left_out = modules_of(package)
        except Exception as error:  # not built, or not there
            missing.append(f"{package}: {error}")
            continue
        missing += [f"{name}: {reason}" for name, reason in left_out]
        rows.append(f"<h2>{package}</h2>\n")
        for name in modules:
            (out / f"{name}.html").write_text(module_page(name), encoding="utf-8")
            first = (pydoc.getdoc(importlib.import_module(name)).splitlines() or [""])[0]
            rows.append(f'<p><a href="{name}.html"><code>{name}</code></a> {html.escape(first)}</p>\n')
    (out / "index.html").write_text(
        _HEAD.format(title="Reference") + "<h1>Reference</h1>\n" + "".join(rows) + "</body></html>\n", encoding="utf-8"
    )
    return missing


def main(arguments):
    if any(argument.startswith("-") for argument in arguments):
        asked = arguments[0] in ("-h", "--help")
        print(__doc__.strip(), file=sys.stdout if asked else sys.stderr)
        return 0 if asked else 2
    missing = write(arguments or PACKAGES, OUT)
    for line in missing:
        print(f"left out: {line}", file=sys.stderr)
    print(f"{OUT / 'index.html'}: {len(list(OUT.glob('*.html'))) - 1} modules")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
