class Law:
    """The law of ``pid_law.h``, with gains."""

    def __init__(self) -> None: ...
    def _set_gains(self, p: float, i: float, d: float, i_max: float, i_min: float, antiwindup: bool) -> None: ...
    def _gains(self) -> tuple[float, float, float, float, float, bool]: ...
    def compute_command(self, error: float, dt: float, error_dot: float | None = ...) -> float:
        """One step.

        :param error: target - measured.
        :param dt: s since the last step.
        :param error_dot: derivative of the error; by default the difference quotient.
        :return: the command; 0.0, with nothing integrated, for dt 0 or an error that is not finite. Always finite.
        """
    def reset(self, d_error: float | None = ..., i_error: float = ...) -> None:
        """Forget the past.

        After a plain reset the last error counts as 0, so the first step sees a derivative of e/dt; give ``d_error``
        to make the first step use that derivative instead.
        """
    @property
    def counted(self) -> bool:
        """Whether the last step could be used."""
    @property
    def p_error(self) -> float: ...
    @property
    def i_error(self) -> float: ...
    @property
    def d_error(self) -> float: ...
    @property
    def i_term(self) -> float: ...
    @property
    def command(self) -> float: ...
