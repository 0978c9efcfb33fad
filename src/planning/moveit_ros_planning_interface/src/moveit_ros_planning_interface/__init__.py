"""The modules that upstream compiles below moveit_commander, for scripts that import them: moveit_commander under their names.

Messages go in and out serialised, as they do there (``moveit_commander.conversions``); setters answer whether they did.
"""
