"""The command rqt_graph: the window, or with --output a file without one."""

import os
import sys

_TYPES = {"nodes": "node_node", "active": "node_topic", "all": "node_topic_all"}
_FORMS = (".dot", ".svg", ".png", ".pdf")
_HIDDEN = ("dead_sinks", "leaf_topics", "debug", "unreachable", "params")
_GROUPS = ("actions", "tf", "images")


def add_arguments(parser):
    """The options of a graph that goes to a file."""
    group = parser.add_argument_group("Options for writing a file instead of opening a window")
    group.add_argument("-o", "--output", metavar="FILE", help="write the graph to FILE (.dot, .svg, .png, .pdf); needs no display")
    group.add_argument("--type", choices=sorted(_TYPES), default="nodes", help="nodes only, or with topics: active or all")
    group.add_argument("--node-filter", default="/", metavar="LIST", help="names or expressions, a leading - excludes: /arm.*,-/rqt.*")
    group.add_argument("--topic-filter", default="/", metavar="LIST", help="as --node-filter, for topics")
    group.add_argument("--namespaces", type=int, default=2, metavar="N", help="boxes around namespaces, nested up to N (2)")
    group.add_argument("--show", nargs="+", choices=_HIDDEN, default=[], help="what is hidden otherwise")
    group.add_argument("--hide", nargs="+", choices=["tf"], default=[], help="what is shown otherwise")
    group.add_argument("--no-group", nargs="+", choices=_GROUPS, default=[], help="topics that are drawn one by one")


def main(argv):
    """Exit code of the command."""
    if any(word in ("-o", "--output") or word.startswith("--output=") for word in argv[1:]):
        return write_file(argv)
    from rqt_gui.main import Main

    return Main(filename=argv[0]).main(argv, standalone="rqt_graph.ros_graph.RosGraph", plugin_argument_provider=add_arguments)


def write_file(argv):
    """Read the graph once and write it. No rospy, no Qt: it takes half a second."""
    import argparse

    from qt_dotgraph.layout import LayoutError, render
    from rosgraph import myargv

    from rqt_graph.dotcode import Options, generate_dot
    from rqt_graph.ros_state import NoMaster, read

    parser = argparse.ArgumentParser("rqt_graph")
    add_arguments(parser)
    arguments = parser.parse_args(myargv(argv)[1:])
    form = os.path.splitext(arguments.output)[1].lower()
    if form not in _FORMS:
        parser.error(f"--output {arguments.output}: its ending must be one of {', '.join(_FORMS)}")
    options = Options(
        _TYPES[arguments.type],
        arguments.node_filter,
        arguments.topic_filter,
        arguments.namespaces,
        hide_tf="tf" in arguments.hide,
        **{f"group_{name}": name not in arguments.no_group for name in _GROUPS},
        **{f"hide_{name}": name not in arguments.show for name in _HIDDEN},
    )
    try:
        dot = generate_dot(read(), options)
        data = dot.encode() if form == ".dot" else render(dot, form[1:])
        with open(arguments.output, "wb") as file:
            file.write(data)
    except (NoMaster, LayoutError) as error:
        print(f"rqt_graph: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"rqt_graph: cannot write {arguments.output}: {error.strerror}", file=sys.stderr)
        return 1
    return 0
