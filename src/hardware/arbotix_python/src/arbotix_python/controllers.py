"""What the driver's main loop asks of a controller."""

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue


def status(name, message="OK", level=DiagnosticStatus.OK, **values):
    """A diagnostics entry `name` with its `message` and `level` (of DiagnosticStatus); `values` become its table."""
    pairs = [KeyValue(key.replace("_", " "), str(value)) for key, value in values.items()]
    return DiagnosticStatus(level=level, name=name, message=message, values=pairs)


class Controller:
    """Base class; `device` is the Driver, which knows the board and the joints."""

    pause = False  # wait for the board's first answer before starting

    def __init__(self, device, name):
        self.device = device
        self.name = name
        self.fake = device.fake  # there is no board
        self.joint_names = []  # joints that are no servos, for joint_states
        self.joint_positions = []
        self.joint_velocities = []

    def startup(self):
        """Called once the board answers."""

    def update(self, now):
        """Called from the main loop; `now` is a rospy.Time."""

    def shutdown(self):
        """Leaves the hardware at rest."""

    def active(self):
        """True while the controller, and nobody else, commands its joints."""
        return False

    def diagnostics(self):
        """A DiagnosticStatus, or None."""
        return status(self.name)

    def getDiagnostics(self):
        return self.diagnostics()
