"""arbotix_terminal: looking at servos and setting them by hand."""

import sys

from .arbotix import BOARD, ArbotiX, ArbotiXException
from .ax12 import P_BAUD_RATE, P_ID

HELP = """Commands:
  ls [HIGHEST [BAUD]]        servos that answer, ids 1 to HIGHEST (18), after setting the bus to BAUD
  mv ID NEW_ID               give a servo another id
  baud BAUD                  set the speed of the bus
  get pos|spd|temp ID        position and goal speed in ticks, temperature in degrees C
  set pos|spd|baud ID VALUE
  help, exit"""
BAUD_CODES = {1000000: 1, 500000: 3, 400000: 4, 250000: 7, 200000: 9, 115200: 16, 57600: 34, 19200: 103, 9600: 207}


def baud_code(text):
    """The servos' code of the bus speed `text`, bit/s. :raises ValueError: there is none"""
    if int(text) not in BAUD_CODES:
        raise ValueError("%s is none of %s" % (text, sorted(BAUD_CODES)))
    return BAUD_CODES[int(text)]


class Terminal:
    def __init__(self, board):
        self._board = board
        self._getters = {
            "pos": board.getPosition,
            "position": board.getPosition,
            "spd": board.getGoalSpeed,
            "speed": board.getGoalSpeed,
            "temp": board.getTemperature,
        }
        self._setters = {"pos": board.setPosition, "position": board.setPosition, "spd": board.setSpeed, "speed": board.setSpeed}

    def run(self, words):
        """Carries out one command, a list of words; returns the text to print. ValueError: not understood."""
        if words == ["help"]:
            return HELP
        if words[0] == "ls" and len(words) <= 3:
            if len(words) == 3:
                self._board.setBaud(BOARD, baud_code(words[2]))
            found = [str(index) for index in range(1, int(words[1]) + 1 if len(words) > 1 else 19) if self._board.getPosition(index) != -1]
            return " ".join(found) or "no servo answers"
        if words[0] == "mv" and len(words) == 3:
            return self._done(self._board.write(int(words[1]), P_ID, [int(words[2])]))
        if words[0] == "baud" and len(words) == 2:
            return self._done(self._board.setBaud(BOARD, baud_code(words[1])))
        if words[0] == "get" and len(words) == 3 and words[1] in self._getters:
            value = self._getters[words[1]](int(words[2]))
            return "no answer" if value == -1 else str(value)
        if words[0] == "set" and len(words) == 4 and words[1] == "baud":
            return self._done(self._board.write(int(words[2]), P_BAUD_RATE, [baud_code(words[3])]))
        if words[0] == "set" and len(words) == 4 and words[1] in self._setters:
            return self._done(self._setters[words[1]](int(words[2]), int(words[3])))
        raise ValueError("not understood; type help")

    @staticmethod
    def _done(error):
        return "OK" if error == 0 else "no answer" if error == -1 else "error bits 0x%02X" % error


def main():
    arguments = sys.argv[1:]
    try:
        terminal = Terminal(ArbotiX(*arguments[:1], **({"baud": int(arguments[1])} if len(arguments) > 1 else {})))
        print("ArbotiX terminal; type help")
        while True:
            words = input(">> ").split()
            if words in (["exit"], ["quit"]):
                return
            if words:
                try:
                    print(terminal.run(words))
                except ValueError as error:
                    print(error)
    except ArbotiXException as error:
        sys.exit("arbotix_terminal: %s" % error)
    except (KeyboardInterrupt, EOFError):
        print()
