"""What was printed, how programs ended, what was answered."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..examination.simulated_world import Sample
from ..explain import crashed, error_lines, refusal, timeless
from .base import Check, Context, names, search

if TYPE_CHECKING:
    from ..isolation.supervise import Program

_WITHIN = 2.0  # s after the commands


class NoErrorsCheck(Check):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        ignored = self.wanted.get("ignore", [])
        lines = [line for line in error_lines(self.context.log()) if not any(search(pattern, line) for pattern in ignored)]
        if lines:
            return False, f"{len(lines)} error lines, the first: {timeless(lines[0])[:200]}", {}
        return True, "nothing was reported as an error", {}


class ExitCheck(Check):
    """How a program of the task's ``run`` ended, or that it goes on; what it printed."""

    in_wall_time = True

    def __init__(self, wanted: Any, context: Context):
        super().__init__(wanted, context)
        self._ends = "code" in wanted or wanted.get("refused")
        self.horizon = wanted.get("within", _WITHIN) if self._ends else 0.0
        self.patience = wanted.get("within", _WITHIN) if "says" in wanted and not self._ends else 0.0

    @property
    def settled(self) -> bool:
        program = self.context.actor.runs.get(self.wanted["run"])
        return program is None or not program.running

    @settled.setter
    def settled(self, value: bool) -> None:
        del value

    def sample(self, sample: Sample) -> None:
        del sample

    def there(self) -> bool:
        program = self.context.actor.runs.get(self.wanted["run"])
        return program is None or not program.running or bool(search(self.wanted["says"], program.output.text()))

    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        program = self.context.actor.runs.get(self.wanted["run"])
        if program is None:
            return False, "the program was not started", {}
        if self._ends:
            self.context.bench.leave(program)
        said = program.output.text()
        last = timeless(next((line for line in reversed(said.splitlines()) if line.strip()), "nothing"))[:160]
        if program.broke:
            return False, f"the program was ended: {program.broke}", {}
        if "Couldn't find executable" in said or "[rosrun]" in said:
            return False, f"the program could not be started: {last}", {}
        if self.wanted.get("refused"):
            taken = self._taken(program, said, last)
            if taken:
                return False, taken, {}
        if "code" in self.wanted and program.code != self.wanted["code"]:
            how = "still runs" if program.running else f"ended with code {program.code}"
            return False, f"the program {how}; it should end with {self.wanted['code']} (it last printed: {last})", {}
        if "says" in self.wanted and not search(self.wanted["says"], said):
            return False, f"the program printed nothing like '{self.wanted['says']}'; it last printed: {last}", {}
        if not set(self.wanted) & {"code", "refused", "says"} and not program.running and program.code:
            return False, f"the program ended with code {program.code}: {last}", {}
        return True, "the program did as it should" + (f": {last}" if self.wanted.get("refused") else ""), {}

    def _taken(self, program: Program, said: str, last: str) -> str:
        """Why a wrong argument was not refused; '' when it was: by an exit code that is not 0, or by what the program said.

        Many programs print how they are used and end with 0; one that ends with 0 and says nothing has taken the argument for a good one.
        """
        if program.running:
            return "the program took a wrong argument and went on, instead of refusing it"
        if crashed(program.code, said):
            return f"the program crashed on a wrong argument instead of refusing it: {last}"
        if program.code == 0 and not (search(self.wanted["says"], said) if "says" in self.wanted else refusal(said)):
            return (
                "the program took a wrong argument: it ended with code 0 and did not say what is wrong with it, nor how it is used "
                f"(it last printed: {last})"
            )
        return ""


class AnswerCheck(Check):
    def verdict(self) -> tuple[bool, str, dict[str, Any]]:
        key = self.wanted["call"]
        if key in self.context.actor.lost:  # who ends on a question has not refused it
            return False, f"no answer came: {self.context.actor.lost[key][:200]}", {}
        answer = self.context.actor.answers.get(key)
        refusal = self.context.actor.refusals.get(key)
        if refusal is None and isinstance(answer, dict):
            refusal = next((str(answer) for field in ("success", "ok") if answer.get(field) is False), None)
        if self.wanted.get("refused"):
            return (
                refusal is not None,
                (
                    f"refused, as it should be: {refusal}"
                    if refusal is not None
                    else f"this had to be refused, but was taken: {str(answer)[:160]}"
                ),
                {},
            )
        if answer is None:
            return False, f"no answer came: {refusal or 'nothing was asked'}", {}
        wrong = [
            f"{field} is {str(answer.get(field))[:80]}, not {value}"
            for field, value in self.wanted.get("equals", {}).items()
            if answer.get(field) != value
        ]
        if wrong:
            return False, names(wrong), {}
        if refusal is not None and not self.wanted.get("equals"):
            return False, f"refused: {refusal[:160]}", {}
        return True, "answered as it should", {}
