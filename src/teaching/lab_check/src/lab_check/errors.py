"""What can go wrong when submissions are marked: one tree. Who gets to read the line tells the branches apart.

::

    LabError
    ├── SpecError       the teacher: .problems has a line each, file:line: what is wrong and what to do
    ├── PlaceError      the teacher: a value of a sweep cannot be put where it should go
    ├── SandboxError    the teacher: this machine cannot shut a submission in; with the remedy
    ├── NoPlace         the teacher: reports cannot be written there
    ├── ClusterError    the teacher: no cluster, or no node in it that can examine; with the cure
    ├── Lost            the teacher: the process that knows the cluster is gone, or does not answer
    ├── TooLarge        the teacher: more than a submission may hold is not sent to a cluster
    ├── StagingError    the student: the submission cannot be taken
    ├── CommandError    the student: a command could not be given
    ├── NoRoom          the student: the submission's disk is full, so that no program can be started
    └── Gone            the student: the simulator, the launch or a limit ended the session
"""


class LabError(Exception):
    """The root; the text is the whole line."""
