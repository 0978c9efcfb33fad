"""What can go wrong in the windows: one tree, each error one line for the person in front of it.

::

    WindowError
    ├── PluginLoadError, UsageError, PerspectiveError   qt_gui
    ├── ExpressionError, ROSActionException             rqt_py_common
    ├── TemplateError                                   rqt_py_common: .path is the field without a value
    ├── BagError                                        rqt_bag, rqt_multiplot: a file that is not shown
    ├── FieldError, RosPlotException, DataPlotException rqt_plot
    ├── ConfigError, UrlError                           rqt_multiplot
    ├── PictureError                                    rqt_image_view
    ├── MapError                                        rqt_nav_view
    ├── NoMaster                                        rqt_graph: the master does not answer
    ├── FramesError                                     rqt_tf_tree
    ├── CallError                                       rqt_controller_manager
    ├── DescriptionError                                rqt_joint_trajectory_controller
    ├── LaunchError                                     rqt_launch
    ├── DefinitionError                                 rqt_msg
    └── SavedMessagesError, SavedValuesError            rqt_console, rqt_reconfigure

qt_dotgraph, turtlesim and moveit_setup_assistant stand alone; gzclient's are ode_sim's.
"""


class WindowError(Exception):
    """The root; the text is the whole line."""


class PluginLoadError(WindowError):
    """A plugin cannot be loaded; one line saying which and why."""


class UsageError(WindowError):
    """Options that cannot be obeyed; one line saying why."""


class PerspectiveError(WindowError):
    """A perspective or its file that cannot be used; one line saying why."""
